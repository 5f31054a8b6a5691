// SPDX-License-Identifier: Apache-2.0
//
// The studio: the page, and what its scripts ask for. Every request is a POST of JSON to /api/NAME with the name that
// the page has given itself, but for GET / (the page) and uploads.
//
//   /api/start     what the page begins with: the language, the state, the files that were named
//   /api/files     the files below the root
//   /api/read      a text file
//   /api/write     a text file, whole or not at all
//   /api/upload    a file that was dropped on the page: its name, a line break, its bytes
//   /api/state     the state of the page, which its file keeps
//   /api/compute   a panel's computation: the lengths of the report and of the scene (32 bits each, little-endian), the
//                  report, the scene as pages have it (page_scene in apps/view/page.h, without details), and the scenes
//                  of pieces: "pieces" of the report are their numbers and lengths, 0 for those that the page has
//                  ("has" of the request)
//   /api/item      details of an item of the page's last scene (apps/view/page/item_details.h)
//   /api/progress  how far that has come; /api/cancel stops it
//   /api/export    a set of the last computation, to a file
//   /api/stop      ends the server
//
// What cannot be done is an answer of status 422 with {"error": a line, "field", "offset"}.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "apps/studio/pages/page_table.h"
#include "apps/studio/panels/panel.h"
#include "apps/studio/root/root_folder.h"
#include "apps/studio/server/loopback_server.h"

namespace nef::studio {

/// What a studio is started with.
struct StudioOptions {
  std::filesystem::path root = ".";
  std::vector<std::string> files =
      {};  ///< below the root: at most one .nefstudio, which becomes the state; scenes; sets
  unsigned threads = 0;
  ComputationLimits limits = {};
};

/// The state's file unless one is named.
inline constexpr char kStateFile[] = "studio.nefstudio";

class Studio {
 public:
  /// `stop` is called when a page asks the server to end. Throws InputError for a root or a file that is not there.
  Studio(const StudioOptions& options, std::function<void()> stop);

  /// The answer to a request. Any number of threads may ask.
  WebReply answer(const WebRequest& request);
  /// Cancels what is being computed; nothing is computed from then on.
  void close() { pages_.close(); }

 private:
  WebReply page() const;
  WebReply call(const std::string& name, const std::string& body);
  Json start() const;
  Json read(const Json& request) const;
  Json write(const Json& request) const;
  Json upload(const std::string& body) const;
  Json keep_state(const Json& request);
  Json export_set(const Json& request);
  WebReply compute(const Json& request);
  Json item(const Json& request) const;

  RootFolder root_;
  std::vector<std::string> files_;
  std::string state_file_ = kStateFile;
  std::function<void()> stop_;
  PageTable pages_;
  LoadedFiles loaded_;
  ExpressionCache expressions_;
  PieceNumbers piece_numbers_;
  TilePieces tiles_{piece_numbers_};
  SilhouetteCache silhouettes_;
  SceneCache scenes_{piece_numbers_};
  std::atomic<std::uint64_t> last_scene_ = 0;
  mutable std::mutex state_mutex_;
  std::uint64_t revision_ = 0;  // of the state; a page that has not seen the last one does not overwrite it
};

}  // namespace nef::studio
