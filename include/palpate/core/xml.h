// Streaming XML: a push parser with hard limits, for .dsa recordings and the noise files of the
// prior program. It uses expat; plain documents are scanned directly (xml_scanner.h), which is
// faster. Text of any size passes through in constant memory. Document types and entities are
// refused, since they can only harm a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace palpate {

// Receives the content in document order. Views are valid only inside the call.
class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  // `attributes`: name, value, name, value, .., ended by a null pointer.
  virtual void startElement(std::string_view name, const char* const* attributes) = 0;
  virtual void endElement(std::string_view name) = 0;
  // Takes a piece of text; the text of one element may come in any number of pieces.
  virtual void text(std::string_view piece) = 0;
};

// Limits of a document.
struct XmlLimits {
  int maxDepth = 64;  // nested elements
  // Largest size of one tag, comment or instruction [bytes].
  std::size_t maxMarkupBytes = 1u << 20;
};

// The document is not well-formed or exceeds a limit. offset [bytes] is counted from the document's
// start.
class XmlError : public std::runtime_error {
 public:
  XmlError(const std::string& message, std::uint64_t offset)
      : std::runtime_error(message), offset_(offset) {}
  std::uint64_t offset() const noexcept { return offset_; }

 private:
  std::uint64_t offset_;
};

// Push parser; not thread-safe. push() passes on exceptions that the handler throws.
class XmlParser {
 public:
  explicit XmlParser(XmlHandler& handler, XmlLimits limits = {});
  ~XmlParser();
  XmlParser(const XmlParser&) = delete;
  XmlParser& operator=(const XmlParser&) = delete;

  // Throws XmlError. After any exception the parser must not be used again.
  void push(std::string_view bytes);
  // Call once after the last byte. Throws XmlError when the document is incomplete.
  void finish();
  // Inside a handler call, the position of the handled event [bytes]; otherwise the number of bytes
  // that were parsed.
  std::uint64_t offset() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
