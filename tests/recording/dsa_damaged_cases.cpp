// Every kind of damage that is a change of the example, and what the message must say.
#include "recording/dsa_corpus.h"
#include "testing/testing.h"

namespace palpate::testing {
namespace {

std::string repeated(std::string_view piece, std::size_t count) {
  std::string out;
  out.reserve(piece.size() * count);
  for (std::size_t i = 0; i < count; ++i) out += piece;
  return out;
}

std::string without(std::string text, std::string_view begin, std::string_view end) {
  const std::size_t from = text.find(begin);
  return text.erase(from, text.find(end, from) + end.size() - from);
}

}  // namespace

std::vector<DamagedCase> damagedCases() {
  const std::string good = exampleXml();
  const std::string packed = compressed(good);
  std::vector<DamagedCase> cases;
  const auto addMade =
      [&](std::string name, std::function<std::string()> bytes, std::vector<std::string> parts) {
        cases.push_back({std::move(name), std::move(bytes), std::move(parts)});
      };
  const auto add = [&](std::string name, std::string bytes, std::vector<std::string> parts) {
    addMade(
        std::move(name), [bytes = std::move(bytes)] { return bytes; }, std::move(parts));
  };
  // A change of the example's text; both compressed and plain.
  const auto change = [&](const std::string& name,
                          std::string_view from,
                          std::string_view to,
                          std::vector<std::string> parts) {
    const std::string text = replaced(good, from, to);
    addMade(
        name, [text] { return compressed(text); }, parts);
    add(name + "_plain", text, parts);
  };

  // The container.
  add("empty", "", {"is empty"});
  add("png", "\x89PNG\r\n\x1A\n and so on", {"neither bzip2 nor XML", "\\x89PNG"});
  add("text", "time,value\n1,2\n", {"neither bzip2 nor XML", "time,val"});
  add("blanks", "  \n\n", {"neither bzip2 nor XML"});
  add("gzip", std::string("\x1F\x8B\x08\0", 4), {"neither bzip2 nor XML"});
  add("magic_only", "BZh9", {"ends early", "is cut"});
  add("half_magic", "BZ", {"ends early"});
  add("cut_in_half",
      packed.substr(0, packed.size() / 2),
      {"ends early", "is cut", "nothing of it can be read"});
  add("cut_last_byte", packed.substr(0, packed.size() - 1), {"ends early"});
  add("garbage_behind",
      packed + "garbage",
      {"follow the recording", std::to_string(packed.size())});
  add("zeros_behind", packed + std::string(512, '\0'), {"follow the recording"});
  {
    std::string flipped = packed;
    flipped[flipped.size() / 2] ^= 0x10;
    add("bit_flipped", flipped, {"bzip2 data is damaged near byte", "of the file"});
    flipped = packed;
    flipped[11] ^= 0x01;  // of the block's checksum
    add("wrong_block_checksum", flipped, {"bzip2 data is damaged"});
    flipped = packed;
    flipped[flipped.size() - 2] ^= 0x10;  // of the stream's checksum
    add("wrong_stream_checksum", flipped, {"bzip2 data is damaged"});
  }
  add("empty_stream", compressed(""), {"ends early"});

  // XML.
  add("xml_cut", good.substr(0, good.size() - 10), {"XML", "ends early"});
  add("xml_cut_in_tag",
      compressed(good.substr(0, good.find("</data>") + 3)),
      {"XML", "ends early"});
  add("only_declaration", "<?xml version=\"1.0\"?>", {"XML", "ends early"});
  add("not_closed", replaced(good, "</sensor>", ""), {"mismatched tag"});
  add("two_documents", good + good, {"XML"});
  add("other_root", "<html><body/></html>", {"root element is \"html\""});
  add("svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>", {"root element is \"svg\""});
  add("not_utf8", replaced(good, "mV", "\xFF\xFE"), {"XML", "not well-formed"});
  add("unknown_encoding", replaced(good, "utf-8", "x-none"), {"XML", "encoding"});
  change("document_type", "<root>", "<!DOCTYPE root><root>", {"DOCTYPE"});
  change("billion_laughs",
         "<root>",
         "<!DOCTYPE root [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;\">]><root>&b;",
         {"DOCTYPE"});
  change("external_entity",
         "<root>",
         "<!DOCTYPE root [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><root>&a;",
         {"DOCTYPE"});
  change("undefined_entity", "mV", "&mV;", {"undefined entity"});
  const auto manyTimes = [good](std::string_view before,
                                std::string_view piece,
                                std::size_t count,
                                std::string_view behind) {
    return [=] {
      return replaced(
          good, "<data>", std::string(before) + repeated(piece, count) + std::string(behind));
    };
  };
  const auto deep = [] { return repeated("<root>", 1'000'000); };
  addMade("million_deep", deep, {"nested deeper than 64"});
  addMade("million_deep_packed", [deep] { return compressed(deep()); }, {"nested deeper than 64"});
  addMade("ten_million_elements",
          manyTimes("<data>", "<x/>", 10'000'000, ""),
          {"more than 100000 unknown elements", "\"x\""});
  addMade("giant_attribute",
          manyTimes("<data x=\"", "a", 5'000'000, "\">"),
          {"longer than 1048576 bytes"});
  addMade("giant_comment",
          manyTimes("<!--", "a", 5'000'000, "--><data>"),
          {"longer than 1048576 bytes"});

  // The sensor.
  change("other_number_of_matrices",
         "<num_matrices>1<",
         "<num_matrices>6<",
         {"num_matrices says 6", "there are 1"});
  change("num_matrices_words", "<num_matrices>1<", "<num_matrices>one<", {"num_matrices", "one"});
  change("no_columns", "<cells_x>3</cells_x>", "", {"matrix 0", "no cells_x"});
  change("no_rows", "<cells_y>2</cells_y>", "", {"matrix 0", "no cells_y"});
  change("zero_columns", "<cells_x>3<", "<cells_x>0<", {"matrix 0", "cells_x", "1 to 256"});
  change("negative_rows", "<cells_y>2<", "<cells_y>-2<", {"matrix 0", "cells_y", "\"-2\""});
  change("huge_columns", "<cells_x>3<", "<cells_x>65535<", {"matrix 0", "cells_x", "65535"});
  change("columns_2_to_63", "<cells_x>3<", "<cells_x>9223372036854775808<", {"cells_x"});
  change("columns_nan", "<cells_x>3<", "<cells_x>nan<", {"cells_x", "nan"});
  change("columns_twice",
         "<cells_x>3</cells_x>",
         "<cells_x>3</cells_x><cells_x>3</cells_x>",
         {"cells_x is given twice"});
  change("long_number",
         "<cells_x>3<",
         "<cells_x>" + std::string(100'000, '3') + "<",
         {"cells_x is longer than 4096"});
  change("zero_pitch", "<texel_width>3.4<", "<texel_width>0<", {"texel_width", "above 0"});
  change("negative_pitch", "<texel_width>3.4<", "<texel_width>-3.4<", {"texel_width"});
  change("nan_pitch", "<texel_width>3.4<", "<texel_width>nan<", {"texel_width"});
  change("short_mask",
         "<static_mask>111 111<",
         "<static_mask>111 11<",
         {"matrix 0", "static_mask has 5 characters for 6"});
  change("long_mask",
         "<dynamic_mask>111 111<",
         "<dynamic_mask>111 1111<",
         {"matrix 0", "dynamic_mask has 7"});
  change("strange_mask",
         "<static_mask>111 111<",
         "<static_mask>111 121<",
         {"static_mask holds another character"});
  change("giant_mask",
         "<static_mask>",
         "<static_mask>" + std::string(100'000, '1'),
         {"static_mask is longer than 65536"});
  add("no_sensor", without(good, "<sensor", "</sensor>"), {"data comes before sensor"});
  add("sensor_last",
      replaced(without(good, "<sensor", "</sensor>"), "</root>", "<sensor/></root>"),
      {"data comes before sensor"});
  add("no_matrix", without(good, "<matrix", "</matrix>"), {"no matrix"});
  add("second_sensor",
      replaced(good, "<data>", "<sensor></sensor><data>"),
      {"a second element sensor"});
  add("too_many_matrices",
      replaced(
          good,
          "<matrix ",
          repeated("<matrix><cells_x>1</cells_x><cells_y>1</cells_y></matrix>", 65) + "<matrix "),
      {"more than 64 matrices"});
  add("too_many_places",
      replaced(good,
               "<matrix ",
               repeated("<matrix><cells_x>256</cells_x><cells_y>200</cells_y>"
                        "</matrix>",
                        2) +
                   "<matrix "),
      {"more than 65536 places"});

  // The frames.
  add("no_data", without(good, "<data>", "</data>"), {"no element data"});
  change("second_data", "<temperatures>", "<data></data><temperatures>", {"a second element data"});
  change("no_stamp", "<time_stamp>1400000000032</time_stamp>", "", {"frame 1", "no time_stamp"});
  change("no_frame_data", "<frame_data>C0C00000</frame_data>", "", {"frame 0", "no frame_data"});
  change("two_frame_data",
         "<frame_data>C0C00000</frame_data>",
         "<frame_data>C0C00000</frame_data><frame_data>C0C00000</frame_data>",
         {"frame 0", "a second frame_data"});
  change("two_stamps",
         "<time_stamp>1400000000032</time_stamp>",
         "<time_stamp>1400000000032</time_stamp><time_stamp>1400000000033</time_stamp>",
         {"frame 1", "a second time_stamp"});
  change("stamp_words", ">1400000000032<", ">yesterday<", {"frame 1", "time_stamp", "yesterday"});
  change("stamp_fraction",
         ">1400000000032<",
         ">1400000000032.5<",
         {"frame 1", "isn't a whole number"});
  change("stamp_empty", ">1400000000032<", "><", {"frame 1", "time_stamp"});
  change("stamp_negative", ">1400000000032<", ">-5<", {"frame 1", "1970"});
  change("stamp_far", ">1400000000032<", ">7258118400000<", {"frame 1", "2199"});
  change("stamp_2_to_63", ">1400000000032<", ">9223372036854775808<", {"frame 1", "time_stamp"});
  change("run_too_long",
         ">C0C00000<",
         ">C9742400<",
         {"frame 0", "a run of 1000000 zeros does not fit (0 of 6 values so far)"});
  change("run_one_too_long", ">C0C00000<", ">C0E00000<", {"frame 0", "run of 7 zeros"});
  change("run_too_short", ">C0C00000<", ">C0A00000<", {"frame 0", "only 5 of 6 values"});
  change("run_fraction", ">C0C00000<", ">C0200000<", {"frame 0", "2.5", "not a whole number"});
  change("run_tiny", ">C0C00000<", ">BF000000<", {"frame 0", "0.5", "not a whole number"});
  change("run_huge", ">C0C00000<", ">FF7FFFFF<", {"frame 0", "does not fit"});
  change("value_too_many", "BF800000</", "BF80000042C80000</", {"frame 1", "more than 6 values"});
  change("value_missing", "447A0000 BF800000", "447A0000", {"frame 1", "only 5 of 6 values"});
  change("empty_frame", ">C0C00000<", "><", {"frame 0", "only 0 of 6 values"});
  change("nan_value", "42C80000", "7FC00000", {"frame 1", "not a number", "2 of 6"});
  change("infinite_value", "42C80000", "7F800000", {"frame 1", "not a number"});
  change("negative_infinite_value", "42C80000", "FF800000", {"frame 1", "not a number"});
  change("no_hexadecimal", "42C80000", "42C8000G", {"frame 1", "'G'", "hexadecimal"});
  change("half_token", "42C80000", "42C80", {"frame 1"});
  change("token_cut", "BF800000</", "BF8</", {"frame 1", "3 of 8 hexadecimal digits"});

  // Angles and temperatures.
  change("angle_nan", "60.00000", "nan", {"angle 0", "value 0 of angle_data", "nan"});
  change("angle_infinite", "-90.00000", "inf", {"angle 0", "value 3"});
  change("angle_words", "60.00000", "sixty", {"angle 0", "sixty"});
  change("angle_empty",
         "60.00000, -10.00000, 10.00000, -90.00000, 0.00000, -10.00000, 10.00000",
         "",
         {"angle 0"});
  change("angle_missing_number", "60.00000,", "60.00000,,", {"angle 0", "value 1"});
  change("angle_decimal_comma", "60.00000, -10.00000", "60,00000 -10,00000", {"angle 0"});
  change("temperature_nan", "35.50", "NaN", {"temp 0", "temp_data"});
  change("temperature_no_data",
         "<temp_data>35.50, 35.00, 31.25, 35.25, 31.50, 34.50, 32.00, 44.50, "
         "44.25</temp_data>",
         "",
         {"temp 0", "no temp_data"});
  change("angles_of_two_lengths",
         "</joint_angles>",
         "<angle><time_stamp>1400000000002</time_stamp><angle_data>1, 2</angle_data></angle>"
         "</joint_angles>",
         {"angle 1", "expected 7"});
  change("million_angles", "60.00000, ", repeated("1,", 1000), {"angle 0", "more than 64"});

  // Bombs that fit into memory when made: 650 million values, 25 s each.
  if (!exhaustive()) return cases;
  const auto nothing = [] {
    return framesXml(256, 256, std::vector<std::string>(10'000, "C7800000"));
  };
  addMade("frames_of_nothing",
          [nothing] { return compressed(nothing()); },
          {"more than 64 MB of memory"});
  addMade("frames_of_nothing_plain", nothing, {"more than 64 MB of memory"});
  return cases;
}

}  // namespace palpate::testing
