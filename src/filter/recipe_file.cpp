// Recipes as files.
#include <fstream>

#include "palpate/core/error.h"
#include "palpate/core/output_file.h"
#include "palpate/filter/recipe.h"

namespace palpate {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;

std::string readText(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw FileError(path, "no such file");
  if (std::filesystem::is_directory(path, code)) throw FileError(path, "is a folder");
  std::ifstream in(path, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  if (!in) throw FileError(path, "can't be opened");
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw FileError(path, "can't be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMostBytes) throw FileError(path, "is larger than a megabyte: no recipe");
  return text;
}

}  // namespace

Recipe readRecipe(const std::filesystem::path& path) {
  const std::string text = readText(path);
  try {
    return recipeFromJson(Json::parse(text));
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FormatError(path, error.what());
  }
}

void writeRecipe(const std::filesystem::path& path, const Recipe& recipe, bool overwrite) {
  recipe.validate();
  OutputFile file(path, overwrite ? Overwrite::kReplace : Overwrite::kRefuse);
  file.write(recipeJson(recipe).text() + "\n");
  file.commit();
}

}  // namespace palpate
