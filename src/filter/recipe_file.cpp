// Reads and writes recipe files (recipe.h).
#include "palpate/core/error.h"
#include "palpate/core/output_file.h"
#include "palpate/core/text_file.h"
#include "palpate/filter/recipe.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;

}  // namespace

Recipe readRecipe(const std::filesystem::path& path) {
  const std::string text = readTextFile(path, kMaxBytes);
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
