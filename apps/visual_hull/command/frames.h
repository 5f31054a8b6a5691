// SPDX-License-Identifier: Apache-2.0
//
// Video from files: one hull a frame.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/visual_hull/command/arguments.h"
#include "apps/visual_hull/stream.h"

namespace nef::visual_hull {

/// A path with a place for a number: "frame_%04d/" or "hull_%d.ply".
class NumberedPath {
 public:
  /// Throws InputError, with `option` in front, unless there is exactly one %d or %0Nd.
  NumberedPath(const std::string& pattern, const std::string& option);

  /// The path of a number that is not negative.
  [[nodiscard]] std::filesystem::path of(std::size_t number) const { return with(digits(number)); }

  /// The path with a word in place of the number.
  [[nodiscard]] std::filesystem::path with(const std::string& word) const;

  /// The numbers for which the path exists, in their order.
  [[nodiscard]] std::vector<std::size_t> existing() const;

 private:
  [[nodiscard]] std::string digits(std::size_t number) const;

  std::string before_, after_;
  std::size_t width_ = 0;
};

/// The frames that --frames names, and how each is made. May be used by several threads at once.
class FrameTasks {
 public:
  /// Reads the scene. Throws InputError for options that do not go together, or if there is no frame.
  explicit FrameTasks(const Arguments& arguments);

  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] std::size_t number(std::size_t task) const { return frames_[task]; }
  [[nodiscard]] std::filesystem::path folder(std::size_t task) const { return folders_.of(frames_[task]); }
  /// What the program understood of the scene, as one text.
  [[nodiscard]] const std::string& understanding() const { return understanding_; }

  /// Makes the hull of a frame and writes it. Returns its line of the manifest; a frame that fails has one, too.
  [[nodiscard]] std::string make(std::size_t task, const nef::Monitor& monitor) const;

 private:
  Arguments arguments_;
  NumberedPath folders_;
  NumberedPath outputs_;
  std::vector<std::size_t> frames_;
  std::string understanding_;
  std::unique_ptr<const HullStream> stream_;
};

/// The manifest of a run, beside the hulls: a JSON value a line, first the settings, then a line a frame as it is done.
/// It says what was made from what: frames whose line has the same settings and images, and whose output is there, need
/// not be made again.
class FrameRecord {
 public:
  /// Opens the manifest, or begins one. Throws FileError.
  FrameRecord(const Arguments& arguments, const FrameTasks& tasks);
  ~FrameRecord();

  /// True if the frame was made before; it counts as done then.
  bool keep(std::size_t task);
  /// Takes the line of a frame that has been made, and complains of one that has failed.
  void add(const std::string& line);
  /// How many are done.
  [[nodiscard]] std::size_t done() const { return done_; }

  /// Puts the manifest in order and says what was done. Returns the exit code: 0, 1 if a hull is empty or flat or not
  /// inside its views, 2 if a frame could not be computed.
  int finish();

 private:
  class Manifest;

  const FrameTasks& tasks_;
  nef::Session& session_;
  std::filesystem::path file_;
  std::unique_ptr<Manifest> manifest_;
  std::size_t done_ = 0;
  std::size_t kept_ = 0;
  bool noted_ = false;
  int code_ = 0;
};

/// The hulls of all frames that --frames names, on all threads frame by frame. A frame that fails does not stop the
/// others. Returns the exit code of FrameRecord::finish.
int make_frames(const Arguments& arguments);

}  // namespace nef::visual_hull
