// SPDX-License-Identifier: Apache-2.0
//
// Each request is a function of the JSON that it brings, found by its name. Names of files go through the root folder,
// and what takes long through the table of pages, which bounds it; so neither is repeated in the panels. Errors become
// answers in one place.
#include "apps/studio/studio.h"

#include <algorithm>
#include <array>
#include <set>

#include "apps/program/reports/run_report.h"
#include "apps/studio/panels/expression_field.h"
#include "apps/studio/panels/panels.h"
#include "apps/studio/studio_page.h"
#include "apps/view/page.h"
#include "apps/view/page/item_details.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/version.h"

namespace nef::studio {
namespace {

constexpr std::size_t kMostText = std::size_t{8} << 20U;  // bytes of a text that pages read or write
constexpr std::size_t kMostFilesListed = 2000;

WebReply json_reply(const Json& json, int status = 200) {
  return {
      .status = status, .type = "application/json", .body = json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

Json parse_request(const std::string& body) {
  Json request = Json::parse(body, nullptr, false);
  if (!request.is_object()) throw InputError("the request is not a JSON object");
  return request;
}

// The name that a page has given itself.
std::string page_of(const Json& request) {
  std::string name = text_of(request, "page");
  const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  if (name.empty() || name.size() > 40 || !std::all_of(name.begin(), name.end(), plain)) {
    throw InputError("the name of the page must be letters and digits");
  }
  return name;
}

bool is_text_file(const std::string& name) {
  constexpr std::array kExtensions{"nefstudio", "json", "txt", "cfg", "svg"};
  return std::find(kExtensions.begin(), kExtensions.end(), lower_extension(name)) != kExtensions.end();
}

bool flag(const Json& request, const char* name) {
  const auto found = request.find(name);
  return found != request.end() && found->is_boolean() && found->get<bool>();
}

// The pieces that the page has, by their numbers.
std::set<std::uint64_t> known_pieces(const Json& request) {
  std::set<std::uint64_t> known;
  const auto list = request.find("has");
  if (list == request.end() || !list->is_array()) return known;
  for (const Json& id : *list) {
    if (id.is_number_unsigned()) known.insert(id.get<std::uint64_t>());
  }
  return known;
}

void append_length(std::string& bytes, std::size_t length) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(length >> shift & 0xffU);
}

}  // namespace

Studio::Studio(const StudioOptions& options, std::function<void()> stop)
    : root_(options.root), stop_(std::move(stop)), pages_(options.threads, options.limits) {
  for (const std::string& file : options.files) {
    const std::string name = root_.file(file).lexically_relative(root_.path()).generic_string();
    if (lower_extension(name) == "nefstudio") {
      state_file_ = name;
    } else {
      files_.push_back(name);
    }
  }
}

WebReply Studio::answer(const WebRequest& request) {
  constexpr std::string_view kApi = "/api/";
  if (request.method == "GET" && request.path == "/") return page();
  if (request.method != "POST" || !request.path.starts_with(kApi)) return line_reply(404, "there is no such page");
  try {
    return call(request.path.substr(kApi.size()), request.body);
  } catch (const Cancelled&) {
    return json_reply({{"error", "cancelled"}}, 409);
  } catch (const FieldError& error) {
    return json_reply({{"error", error.what()}, {"field", error.field()}, {"offset", error.offset()}}, 422);
  } catch (const Error& error) {
    return json_reply({{"error", error.what()}}, 422);
  }
}

// Nothing is fetched from elsewhere, and no other page may show this one in a frame.
WebReply Studio::page() const {
  const std::string policy =
      "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; connect-src "
      "'self'; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
  return {.type = "text/html; charset=utf-8",
          .body = std::string(studio_page()),
          .headers = {{"Content-Security-Policy", policy}}};
}

WebReply Studio::call(const std::string& name, const std::string& body) {
  if (name == "upload") return json_reply(upload(body));
  if (body.size() > 2 * kMostText) throw InputError("the request is too long");
  const Json request = parse_request(body);
  if (name == "compute") return compute(request);
  if (name == "start") return json_reply(start());
  if (name == "files") {
    Json files = Json::array();
    for (const RootFile& file : root_.list(kMostFilesListed)) {
      files.push_back({{"name", file.name}, {"bytes", file.bytes}});
    }
    return json_reply({{"files", files}});
  }
  if (name == "read") return json_reply(read(request));
  if (name == "write") return json_reply(write(request));
  if (name == "state") return json_reply(keep_state(request));
  if (name == "item") return json_reply(item(request));
  if (name == "export") return json_reply(export_set(request));
  if (name == "cancel") {
    pages_.cancel(page_of(request));
    return json_reply(Json::object());
  }
  if (name == "progress") {
    const auto progress = pages_.progress(page_of(request));
    if (!progress) return json_reply({{"running", false}});
    return json_reply({{"running", true},
                       {"phase", progress->phase},
                       {"done", progress->done},
                       {"total", progress->total},
                       {"seconds", progress->seconds}});
  }
  if (name == "stop") {
    stop_();
    return json_reply(Json::object());
  }
  return line_reply(404, "there is no such request");
}

Json Studio::start() const {
  const std::lock_guard lock(state_mutex_);
  std::error_code error;
  Json state;
  if (std::filesystem::exists(root_.path() / state_file_, error)) state = root_.read(state_file_, kMostText);
  return {{"version", NEF_VERSION},
          {"root", root_.path().string()},
          {"files", files_},
          {"state", state},
          {"state_file", state_file_},
          {"revision", revision_},
          {"language", language_json()}};
}

Json Studio::read(const Json& request) const {
  const std::string name = text_of(request, "name");
  if (!is_text_file(name))
    throw InputError(name + ": only .nefstudio, .json, .cfg, .svg and .txt files are read as text");
  return {{"text", root_.read(name, kMostText)}};
}

Json Studio::write(const Json& request) const {
  const std::string name = text_of(request, "name");
  if (!is_text_file(name))
    throw InputError(name + ": text is written to .nefstudio, .json, .cfg, .svg and .txt files only");
  const std::string text = text_of(request, "text");
  if (text.size() > kMostText) throw InputError(name + ": the text has more than 8 MiB");
  std::error_code error;
  if (!flag(request, "overwrite") && std::filesystem::exists(root_.target(name), error)) {
    throw InputError(name + ": this file is there already");
  }
  root_.write(name, text);
  return {{"name", name}};
}

Json Studio::upload(const std::string& body) const {
  const std::size_t line = body.find('\n');
  if (line == std::string::npos || line > 1000) throw InputError("the upload has no name");
  const std::string name = body.substr(0, line);
  const std::string_view bytes = std::string_view(body).substr(line + 1);
  if (!is_file_extension(lower_extension(name)) && !is_text_file(name)) {
    throw InputError(name + ": neither a set nor a mesh nor a scene by its extension");
  }
  std::error_code error;
  const std::filesystem::path target = root_.target(name);
  if (std::filesystem::exists(target, error) &&
      (std::filesystem::file_size(target, error) != bytes.size() || read_file(target.string()) != bytes)) {
    throw InputError(name + ": another file of this name is there already; rename one of them");
  }
  root_.write(name, bytes);
  return {{"name", name}};
}

Json Studio::keep_state(const Json& request) {
  const std::string text = text_of(request, "text");
  if (text.size() > kMostText) throw InputError("the state has more than 8 MiB");
  const std::lock_guard lock(state_mutex_);
  if (request.value("revision", Json()) != Json(revision_) && !flag(request, "overwrite")) {
    throw InputError("another page has saved " + state_file_ + " meanwhile");
  }
  root_.write(state_file_, text);
  return {{"revision", ++revision_}};
}

Json Studio::export_set(const Json& request) {
  const std::string name = text_of(request, "name");
  const std::string page = page_of(request);
  const std::filesystem::path target = root_.target(name);
  std::error_code error;
  if (!flag(request, "overwrite") && std::filesystem::exists(target, error)) {
    throw InputError(name + ": this file is there already");
  }
  const KeptSet set = pages_.set(page, text_of(request, "set"));
  Messages notes;
  pages_.compute(page, [&](const Monitor& monitor) {
    PolyhedronWriteOptions options;
    options.exact = flag(request, "exact");
    options.manifold = flag(request, "manifold");
    options.monitor = monitor;
    set.write(target.string(), options, notes);
    return std::nullopt;
  });
  for (std::string& note : notes) {
    if (note.starts_with(target.string())) note = name + note.substr(target.string().size());
  }
  return {{"name", name}, {"bytes", std::filesystem::file_size(target, error)}, {"notes", notes}};
}

WebReply Studio::compute(const Json& request) {
  const auto panel = panels().find(text_of(request, "panel"));
  if (panel == panels().end()) throw InputError("there is no such panel");
  const std::string page = page_of(request);
  const std::set<std::uint64_t> known = known_pieces(request);
  PanelResult result;
  std::string scene;
  std::string pieces;
  pages_.compute(page, [&](const Monitor& monitor) -> std::optional<Sets> {
    result =
        panel->second(request, {root_, loaded_, expressions_, tiles_, silhouettes_, scenes_, piece_numbers_, monitor});
    view::PageOptions options;
    options.title = panel->first;
    options.details = false;
    scene = view::page_scene(result.layers, options);
    std::vector<Polyhedron> sources;
    for (const view::Layer& layer : result.layers) sources.push_back(layer.scene.source);
    result.report["pieces"] = Json::array();
    for (const Piece& piece : result.pieces) {
      const bool is_known = known.contains(piece.id);
      result.report["pieces"].push_back({piece.id, is_known ? 0 : piece.scene->size()});
      if (!is_known) pieces += *piece.scene;
      sources.push_back(piece.source);
    }
    result.report["scene"] = ++last_scene_;
    pages_.keep_drawn(page, result.report["scene"].get<std::uint64_t>(), std::move(sources));
    return result.sets;
  });
  const std::string report = result.report.dump(-1, ' ', false, Json::error_handler_t::replace);
  WebReply reply;
  reply.type = "application/octet-stream";
  reply.body.reserve(8 + report.size() + scene.size() + pieces.size());
  append_length(reply.body, report.size());
  append_length(reply.body, scene.size());
  reply.body += report;
  reply.body += scene;
  reply.body += pieces;
  return reply;
}

Json Studio::item(const Json& request) const {
  const auto index_of = [](const Json& value) {
    if (!value.is_number_unsigned()) throw InputError("an item is named by its number");
    return value.get<std::uint32_t>();
  };
  const Json& layer = request.value("layer", Json());
  const Json& scene = request.value("scene", Json());
  const Polyhedron source = pages_.drawn(page_of(request), index_of(scene), index_of(layer));
  std::vector<std::uint32_t> vertices;
  const Json wanted = request.value("vertices", Json::array());
  if (!wanted.is_array() || wanted.size() > 2) throw InputError("an item has at most two vertices");
  for (const Json& vertex : wanted) vertices.push_back(index_of(vertex));
  std::optional<std::uint32_t> facet;
  if (const Json value = request.value("facet", Json()); !value.is_null()) facet = index_of(value);
  return Json(view::item_details(source, vertices, facet));
}

}  // namespace nef::studio
