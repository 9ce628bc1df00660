// Streaming XML: a push parser with hard limits, over expat (plain documents are scanned directly,
// which is faster; anything else in them is expat's). Text of any size passes through in
// constant memory; document types and entities are refused (they can only harm a recording).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace palpate {

// Called in document order. Views are valid only inside the call.
class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  // `attributes`: name, value, name, value, .., ended by a null pointer.
  virtual void startElement(std::string_view name, const char* const* attributes) = 0;
  virtual void endElement(std::string_view name) = 0;
  // A piece of text; one element's text may come in any number of pieces.
  virtual void text(std::string_view piece) = 0;
};

struct XmlLimits {
  int maxDepth = 64;                      // nested elements
  std::size_t maxMarkupBytes = 1u << 20;  // one tag, comment or instruction [bytes]
};

// The document is not well-formed or breaks a limit. offset [bytes] from the document's start.
class XmlError : public std::runtime_error {
 public:
  XmlError(const std::string& message, std::uint64_t offset)
      : std::runtime_error(message), offset_(offset) {}
  std::uint64_t offset() const noexcept { return offset_; }

 private:
  std::uint64_t offset_;
};

// Push parser; not thread-safe. An exception thrown by the handler passes through push() unharmed.
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
  // Position of the event being handled [bytes], inside a handler call; else of the bytes taken.
  std::uint64_t offset() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// `text` with the five special characters written as entities, fit for text and attributes.
std::string xmlEscaped(std::string_view text);

}  // namespace palpate
