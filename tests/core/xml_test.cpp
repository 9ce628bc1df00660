// The XML wrapper: events, limits, refusals, and exceptions that cross expat's C code.
#include "palpate/core/xml.h"

#include <string>
#include <vector>

#include "core/xml_scanner.h"
#include "testing/testing.h"

namespace palpate::xml_test {
namespace {

// Writes down what it is told.
class Notes : public XmlHandler {
 public:
  void startElement(std::string_view name, const char* const* attributes) override {
    flush();
    std::string note = "<" + std::string(name);
    for (; *attributes; attributes += 2)
      note += std::string(" ") + attributes[0] + "=" + attributes[1];
    notes.push_back(note);
  }
  void endElement(std::string_view name) override {
    flush();
    notes.push_back("/" + std::string(name));
  }
  void text(std::string_view piece) override {
    pending_ += piece;
    longestPiece = std::max(longestPiece, piece.size());
    textBytes += piece.size();
  }

  std::vector<std::string> notes;
  std::size_t longestPiece = 0;
  std::size_t textBytes = 0;

 private:
  void flush() {
    if (!pending_.empty()) notes.push_back(pending_);
    pending_.clear();
  }
  std::string pending_;
};

std::string errorOf(std::string_view document, XmlLimits limits = {}) {
  Notes notes;
  XmlParser parser(notes, limits);
  try {
    parser.push(document);
    parser.finish();
  } catch (const XmlError& error) {
    return error.what();
  }
  return "";
}

TEST(Xml, tellsElementsAttributesAndTextInOrder) {
  Notes notes;
  XmlParser parser(notes);
  parser.push("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<a x=\"1\" y='2'>t&amp;u<b/>");
  parser.push("v<![CDATA[<w>]]></a>");
  parser.finish();
  const std::vector<std::string> expected = {"<a x=1 y=2", "t&u", "<b", "/b", "v<w>", "/a"};
  EXPECT_EQ(notes.notes, expected);
}

TEST(Xml, tellsTheSameHoweverTheBytesAreCut) {
  const std::string document = "\xEF\xBB\xBF<a k=\"v\">one<b>two</b><!-- no --></a>";
  Notes whole;
  XmlParser wholeParser(whole);
  wholeParser.push(document);
  wholeParser.finish();
  for (std::size_t step = 1; step <= 7; ++step) {
    Notes cut;
    XmlParser parser(cut);
    for (std::size_t at = 0; at < document.size(); at += step)
      parser.push(std::string_view(document).substr(at, step));
    parser.finish();
    EXPECT_EQ(cut.notes, whole.notes) << step;
  }
}

// What a document tells: its notes, then the error if any. With `throughExpat` a comment in front
// makes expat read all of it.
std::vector<std::string> told(std::string document, bool throughExpat, std::size_t step) {
  constexpr std::string_view kDeclaration = "<?xml version=\"1.0\" encoding=\"utf-8\"?>";
  if (throughExpat)
    document.insert(document.starts_with(kDeclaration) ? kDeclaration.size() : 0, "<!---->");
  Notes notes;
  XmlParser parser(notes);
  try {
    for (std::size_t at = 0; at < document.size(); at += step)
      parser.push(std::string_view(document).substr(at, step));
    parser.finish();
  } catch (const XmlError& error) {
    // Text right before an error may or may not have been told: it is not compared.
    const std::uint64_t shift = throughExpat && error.offset() >= 7 ? 7 : 0;
    if (error.what() != std::string("it ends early"))
      notes.notes.push_back(std::to_string(error.offset() - shift));
    notes.notes.push_back(error.what());
  }
  return notes.notes;
}

// Plain documents never meet expat. Wherever something else stands, expat takes over: both ways
// must tell the same.
TEST(Xml, tellsTheSameWhoeverReadsIt) {
  const std::vector<std::string> documents = {
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<a>\r\n  <b i=\"0\" j='x "
      "y'>t\rx\n</b>\r\n</a>\n",
      "<a><b><c/></b><!-- c --><d>e</d></a>",
      "<a>x&lt;y<b k=\"&amp;\">\xC3\xA4</b></a>",
      "<a>x<b>y<![CDATA[z]]></b>]]</a>",
      "<a>x]]></a>",
      "<a>1</b>",
      "<a>1</a >2",
      "<a>1</a>\n<b/>",
      "<a/>\n\r\t ",
      "<a/><?p?><!-- c -->",
      "<a/>text",
      "  \n<a/>",
      "text<a/>",
      "<a b=\"1\" b=\"2\"/>",
      "<a b=\"1\"c=\"2\"/>",
      "<a b=1/>",
      "<a b=\"x>y\"/>",
      "<a b=\"x<y\"/>",
      "<a b=\"x\ty\"/>",
      "<a b = \"x\"/>",
      "<a\n  b=\"x\"\n/>",
      "<a b=\"/\"></a>",
      "<a/ >",
      "<a / >",
      "< a/>",
      "<1/>",
      "<a:b/>",
      "<\xC3\xA4>\xC3\xA4</\xC3\xA4>",
      "<a>\x01</a>",
      "<a>\x7F</a>",
      "<a>\xFF</a>",
      "<a>\r\r\n\n\r</a>",
      "<a>\r&lt;\r\n&gt;\r</a>",
      "<a>\r<!-- -->\r\n<!-- -->\n</a>",
      "<>",
      "</a>",
      "<a></>",
      "<a></a",
      "<a><b></a></b>",
      "<a>&x;</a>",
      "<a><" + std::string(2000, 'b') + "/></a>",
      "<a " + std::string(2000, ' ') + "b=\"c\"/>",
  };
  for (const std::string& document : documents)
    for (const std::size_t step : {std::size_t{1}, std::size_t{2}, std::size_t{5}, document.size()})
      EXPECT_EQ(told(document, false, step), told(document, true, step)) << document << " " << step;
}

// expat tells the same, but takes its time: attributes of both quotes don't need it.
TEST(Xml, whatIsPlainIsNotLeftToExpat) {
  Notes notes;
  XmlScanner scanner(notes, 10);
  EXPECT_TRUE(scanner.push("<a x=\"1\" y='2'/>"));
  EXPECT_TRUE(scanner.complete());
  EXPECT_EQ(notes.notes, (std::vector<std::string>{"<a x=1 y=2", "/a"}));
}

TEST(Xml, aDeclarationStandsOnlyAtTheBeginning) {
  const std::string declaration = "<?xml version=\"1.0\" encoding=\"utf-8\"?>";
  EXPECT_EQ(errorOf(declaration + "<a/>"), "");
  EXPECT_EQ(errorOf("<?xml version='1.0'?><a/>"), "");
  EXPECT_NE(errorOf(declaration + declaration + "<a/>"), "");
  EXPECT_NE(errorOf("\n" + declaration + "<a/>"), "");
  EXPECT_NE(errorOf("<a/>" + declaration), "");
  EXPECT_NE(errorOf("<a>" + declaration + "</a>"), "");
  EXPECT_NE(errorOf(declaration + "\xEF\xBB\xBF<a/>"), "");
  EXPECT_NE(errorOf(declaration), "");
}

TEST(Xml, refusesDocumentTypesAndEntities) {
  EXPECT_NE(errorOf("<!DOCTYPE a><a/>").find("DOCTYPE"), std::string::npos);
  const std::string laughs =
      "<!DOCTYPE a [<!ENTITY x \"ha\"><!ENTITY y \"&x;&x;&x;\">]><a>&y;&y;</a>";
  EXPECT_NE(errorOf(laughs).find("DOCTYPE"), std::string::npos);
  EXPECT_NE(errorOf("<a>&undefined;</a>"), "");
}

TEST(Xml, boundsTheDepth) {
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  EXPECT_NE(errorOf(deep).find("deeper than 64"), std::string::npos);
  XmlLimits limits;
  limits.maxDepth = 2;
  EXPECT_EQ(errorOf("<a><b/><b/></a>", limits), "");
  EXPECT_NE(errorOf("<a><b><c/></b></a>", limits), "");
}

TEST(Xml, boundsOneTag) {
  XmlLimits limits;
  limits.maxMarkupBytes = 100'000;
  EXPECT_EQ(errorOf("<a b=\"" + std::string(10'000, 'x') + "\"/>", limits), "");
  EXPECT_NE(errorOf("<a b=\"" + std::string(1'000'000, 'x') + "\"/>", limits).find("longer than"),
            std::string::npos);
  EXPECT_NE(errorOf("<!-- " + std::string(1'000'000, 'x') + "--><a/>", limits), "");
}

TEST(Xml, passesTextOfAnyLengthOnInPieces) {
  constexpr std::size_t kBytes = 20u << 20;
  Notes notes;
  XmlParser parser(notes);
  parser.push("<a>");
  const std::string blanks(1u << 20, ' ');
  for (std::size_t done = 0; done < kBytes; done += blanks.size()) parser.push(blanks);
  parser.push("</a>");
  parser.finish();
  EXPECT_EQ(notes.textBytes, kBytes);
  EXPECT_LE(notes.longestPiece, 1u << 20);
}

TEST(Xml, namesThePlaceOfAnError) {
  Notes notes;
  XmlParser parser(notes);
  try {
    parser.push("<a>1234</b>");
    FAIL();
  } catch (const XmlError& error) {
    EXPECT_GE(error.offset(), 7u);  // "</b>" begins there
    EXPECT_LE(error.offset(), 9u);
  }
}

TEST(Xml, tellsADocumentThatEndsEarly) {
  EXPECT_NE(errorOf("<a><b>").find("ends early"), std::string::npos);
  EXPECT_NE(errorOf("<a").find("ends early"), std::string::npos);
  EXPECT_NE(errorOf("").find("ends early"), std::string::npos);
  EXPECT_NE(errorOf("<a/>more"), "");
}

TEST(Xml, letsTheHandlersExceptionThrough) {
  struct Stop {};
  class Thrower : public XmlHandler {
   public:
    void startElement(std::string_view, const char* const*) override { ++calls; }
    void endElement(std::string_view name) override {
      ++calls;
      if (name == "b") throw Stop();
    }
    void text(std::string_view) override { ++calls; }
    int calls = 0;
  } thrower;
  XmlParser parser(thrower);
  // Behind the empty element expat has more to tell; nothing of it may arrive.
  EXPECT_THROW(parser.push("<a><b/>text<c/></a>"), Stop);
  EXPECT_EQ(thrower.calls, 3);
  EXPECT_GE(parser.offset(), 3u);  // where "<b/>" stands
  EXPECT_LE(parser.offset(), 7u);
}

}  // namespace
}  // namespace palpate::xml_test
