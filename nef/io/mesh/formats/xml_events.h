// SPDX-License-Identifier: Apache-2.0
//
// XML as events, through expat.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nef {

/// A tag that opens: names without their prefixes; attributes of another namespace are called "namespace|name".
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;

  /// Null if there is none.
  [[nodiscard]] const std::string* find(std::string_view attribute) const;
};

/// Parses a document that comes in pieces. Refuses documents with a document type, which may define entities, and those
/// with a tag or a comment of more than 1 MiB.
class XmlEvents {
 public:
  using Open = std::function<void(const XmlElement&)>;
  using Close = std::function<void(const std::string& name)>;

  /// `where` stands in front of messages. Errors that the functions throw pass through.
  XmlEvents(std::string where, Open open, Close close);
  ~XmlEvents();
  XmlEvents(const XmlEvents&) = delete;
  XmlEvents& operator=(const XmlEvents&) = delete;

  /// Throws FileError with the line for what is not well formed.
  void parse(std::string_view piece, bool last = false);
  /// "where:line"
  [[nodiscard]] std::string place() const;
  /// The URI that a prefix of the element just opened stands for; empty if it stands for none.
  [[nodiscard]] std::string uri(const std::string& prefix) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nef
