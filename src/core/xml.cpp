#include "palpate/core/xml.h"

#include <algorithm>
#include <cstdint>
#include <exception>

#include <expat.h>

#include "core/xml_scanner.h"

namespace palpate {
namespace {

// expat scans an unfinished tag again with each piece, and keeps all of it. With small pieces the
// limit is checked often enough.
constexpr std::size_t kPieceBytes = 64u << 10;

bool endsEarly(XML_Error code) {
  return code == XML_ERROR_NO_ELEMENTS || code == XML_ERROR_UNCLOSED_TOKEN ||
         code == XML_ERROR_PARTIAL_CHAR || code == XML_ERROR_UNCLOSED_CDATA_SECTION;
}

// Where the current event begins [bytes]; negative where there is none.
std::int64_t eventIndex(XML_Parser parser) {
#if XML_MAJOR_VERSION > 2 || (XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION >= 9)
  return XML_GetCurrentByteIndex64(parser);
#else
  return XML_GetCurrentByteIndex(parser);
#endif
}

}  // namespace

struct XmlParser::Impl {
  Impl(XmlHandler& target, XmlLimits bounds)
      : handler(target), limits(bounds), scanner(target, bounds.maxDepth) {}
  ~Impl() {
    if (parser) XML_ParserFree(parser);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // From here on expat parses. It first reads the prefix without handlers, to get into the
  // scanner's state.
  void leaveScanner() {
    const std::string prefix = scanner.prefix();
    parser = XML_ParserCreate(nullptr);
    if (!parser) throw std::bad_alloc();
    XML_SetUserData(parser, this);
    XML_SetStartDoctypeDeclHandler(parser, &Impl::onDoctype);
    taken = scanner.position() - prefix.size();  // may wrap around: only differences count
    origin = taken;
    if (!prefix.empty()) parse(prefix, false);
    XML_SetElementHandler(parser, &Impl::onStart, &Impl::onEnd);
    XML_SetCharacterDataHandler(parser, &Impl::onText);
    depth = scanner.depth();
  }

  // No exception may pass through expat's C code. It is stored, the parser is stopped, and the
  // exception is thrown again after expat has returned. expat may call a handler once more after
  // the stop.
  template <typename Call>
  void guarded(Call&& call) noexcept {
    if (failure) return;
    inHandler = true;
    try {
      call();
    } catch (...) {
      failure = std::current_exception();
      failureOffset = eventOffset();
      XML_StopParser(parser, XML_FALSE);
    }
    inHandler = false;
  }

  static void onStart(void* data, const XML_Char* name, const XML_Char** attributes) {
    auto& self = *static_cast<Impl*>(data);
    self.guarded([&] {
      if (++self.depth > self.limits.maxDepth)
        throw XmlError(
            "elements are nested deeper than " + std::to_string(self.limits.maxDepth) + " levels",
            self.eventOffset());
      self.handler.startElement(name, attributes);
    });
  }
  static void onEnd(void* data, const XML_Char* name) {
    auto& self = *static_cast<Impl*>(data);
    self.guarded([&] {
      --self.depth;
      self.handler.endElement(name);
    });
  }
  static void onText(void* data, const XML_Char* text, int size) {
    auto& self = *static_cast<Impl*>(data);
    self.guarded([&] { self.handler.text({text, static_cast<std::size_t>(size)}); });
  }
  static void onDoctype(
      void* data, const XML_Char*, const XML_Char*, const XML_Char*, int /*hasInternalSubset*/) {
    auto& self = *static_cast<Impl*>(data);
    self.guarded([&] {
      throw XmlError("document types (DOCTYPE) and entities are not allowed here",
                     self.eventOffset());
    });
  }

  std::uint64_t eventOffset() const noexcept {
    const std::int64_t index = eventIndex(parser);
    return index < 0 ? scanner.position() : origin + static_cast<std::uint64_t>(index);
  }

  void parse(std::string_view piece, bool last) {
    const XML_Status status = XML_Parse(
        parser, piece.data(), static_cast<int>(piece.size()), last ? XML_TRUE : XML_FALSE);
    taken += piece.size();
    if (failure) std::rethrow_exception(failure);
    if (status == XML_STATUS_OK) return;
    const XML_Error code = XML_GetErrorCode(parser);
    if (code == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    if (last && endsEarly(code)) throw XmlError("it ends early", taken);
    throw XmlError(XML_ErrorString(code), eventOffset());
  }

  XmlHandler& handler;
  XmlLimits limits;
  XmlScanner scanner;
  XML_Parser parser = nullptr;  // set when the scanner has met something that it leaves to expat
  std::uint64_t origin = 0;     // start of expat's positions in the document [bytes]
  std::exception_ptr failure;
  std::uint64_t failureOffset = 0;
  std::uint64_t taken = 0;
  int depth = 0;
  bool inHandler = false;
};

XmlParser::XmlParser(XmlHandler& handler, XmlLimits limits)
    : impl_(std::make_unique<Impl>(handler, limits)) {}
XmlParser::~XmlParser() = default;

void XmlParser::push(std::string_view bytes) {
  if (!impl_->parser) {
    if (impl_->scanner.push(bytes)) return;
    impl_->leaveScanner();
    bytes = impl_->scanner.rest();
  }
  while (!bytes.empty()) {
    const std::string_view piece = bytes.substr(0, kPieceBytes);
    bytes.remove_prefix(piece.size());
    impl_->parse(piece, false);
    // expat holds back only unfinished markup; it passes text on at once.
    const std::uint64_t begin = impl_->eventOffset();
    if (impl_->taken - std::min(begin, impl_->taken) > impl_->limits.maxMarkupBytes)
      throw XmlError("one tag or comment is longer than " +
                         std::to_string(impl_->limits.maxMarkupBytes) + " bytes",
                     begin);
  }
}

void XmlParser::finish() {
  if (impl_->parser) return impl_->parse({}, true);
  if (!impl_->scanner.complete()) throw XmlError("it ends early", impl_->scanner.position());
}

std::uint64_t XmlParser::offset() const noexcept {
  if (!impl_->parser) return impl_->scanner.offset();
  if (impl_->failure) return impl_->failureOffset;
  return impl_->inHandler ? impl_->eventOffset() : impl_->taken;
}

}  // namespace palpate
