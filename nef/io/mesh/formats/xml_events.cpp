// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/formats/xml_events.h"

#include <expat.h>

#include <exception>
#include <map>

#include "nef/io/file_bytes.h"

namespace nef {
namespace {

constexpr char kSeparator = '|';
// Bytes of one tag, comment or the like. Expat looks at an unfinished one from its beginning whenever a piece is added,
// so long ones would take quadratic time.
constexpr std::size_t kLongestToken = std::size_t{1} << 20U;

std::string local_name(const char* name) {
  const std::string text = name;
  const std::size_t at = text.rfind(kSeparator);
  return at == std::string::npos ? text : text.substr(at + 1);
}

}  // namespace

struct XmlEvents::State {
  std::string where;
  Open open;
  Close close;
  XML_Parser parser = nullptr;
  XmlElement element;
  std::map<std::string, std::string> uris;  // of prefixes, whatever their scope
  std::exception_ptr thrown;                // by a function; no exception may go through the C code of expat
  bool document_type = false;
  std::size_t parsed = 0;  // bytes

  template <typename Function>
  void guard(Function&& function) {
    if (thrown) return;
    try {
      function();
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static void on_open(void* data, const char* name, const char** attributes) {
    auto& state = *static_cast<State*>(data);
    state.guard([&] {
      state.element.name = local_name(name);
      state.element.attributes.clear();
      for (const char** a = attributes; *a != nullptr; a += 2) state.element.attributes.emplace_back(a[0], a[1]);
      state.open(state.element);
    });
  }
  static void on_close(void* data, const char* name) {
    auto& state = *static_cast<State*>(data);
    state.guard([&] { state.close(local_name(name)); });
  }
  static void on_namespace(void* data, const char* prefix, const char* uri) {
    auto& state = *static_cast<State*>(data);
    state.guard([&] { state.uris[prefix != nullptr ? prefix : ""] = uri != nullptr ? uri : ""; });
  }
  static void on_document_type(void* data, const char*, const char*, const char*, int) {
    auto& state = *static_cast<State*>(data);
    state.document_type = true;
    XML_StopParser(state.parser, XML_FALSE);
  }
};

const std::string* XmlElement::find(std::string_view attribute) const {
  for (const auto& [name, value] : attributes) {
    if (name == attribute) return &value;
  }
  return nullptr;
}

XmlEvents::XmlEvents(std::string where, Open open, Close close) : state_(new State) {
  state_->where = std::move(where);
  state_->open = std::move(open);
  state_->close = std::move(close);
  state_->parser = XML_ParserCreateNS(nullptr, kSeparator);
  if (state_->parser == nullptr) throw std::bad_alloc();
  XML_SetUserData(state_->parser, state_.get());
  XML_SetElementHandler(state_->parser, State::on_open, State::on_close);
  XML_SetStartNamespaceDeclHandler(state_->parser, State::on_namespace);
  XML_SetStartDoctypeDeclHandler(state_->parser, State::on_document_type);
}

XmlEvents::~XmlEvents() { XML_ParserFree(state_->parser); }

void XmlEvents::parse(std::string_view piece, bool last) {
  const XML_Status status =
      XML_Parse(state_->parser, piece.data(), static_cast<int>(piece.size()), last ? XML_TRUE : XML_FALSE);
  if (state_->thrown) std::rethrow_exception(state_->thrown);
  if (state_->document_type) {
    throw FileError(FileProblem::kUnsupported, place() + ": a document type is not allowed in these files");
  }
  if (status == XML_STATUS_ERROR) {
    throw FileError(FileProblem::kSyntax,
                    place() + ": not valid XML: " + XML_ErrorString(XML_GetErrorCode(state_->parser)));
  }
  state_->parsed += piece.size();
  const XML_Index token = XML_GetCurrentByteIndex(state_->parser);
  if (token >= 0 && state_->parsed - static_cast<std::size_t>(token) > kLongestToken) {
    throw FileError(FileProblem::kUnsupported, place() + ": a tag, an attribute or a comment of more than 1 MiB");
  }
}

std::string XmlEvents::place() const {
  return state_->where + ":" + std::to_string(XML_GetCurrentLineNumber(state_->parser));
}

std::string XmlEvents::uri(const std::string& prefix) const {
  const auto found = state_->uris.find(prefix);
  return found == state_->uris.end() ? "" : found->second;
}

}  // namespace nef
