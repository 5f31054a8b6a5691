// SPDX-License-Identifier: Apache-2.0
//
// Frames are independent tasks, one for each thread. The manifest makes a run resumable: a line is appended and flushed
// when a frame is done, so a killed run loses the frames in progress only. A frame is skipped if its line has the same
// settings, the same hash of its images, and its output exists; the manifest is sorted when the run ends.
#include "apps/visual_hull/command/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/visual_hull/command/hull_file.h"
#include "apps/visual_hull/command/report.h"
#include "apps/visual_hull/scene/understanding.h"
#include "apps/visual_hull/stream.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/geometry/vectors.h"
#include "nef/io/content_hash.h"
#include "nef/io/file_bytes.h"
#include "nef/query/measures/approximate_volume.h"
#include "nef/version.h"

namespace nef::visual_hull {
namespace fs = std::filesystem;

namespace {

using json = nlohmann::ordered_json;

// What tells the images of a folder, or other files, from those that stood there before: a hash of all that is in them.
std::string state_of(const fs::path& path) {
  try {
    return nef::content_hash_of_file(path.string());
  } catch (const nef::Error&) {
    return "unreadable";
  }
}

// All that a hull depends on but its images.
json settings_of(const Arguments& a) {
  const fs::path scene = fs::absolute(a.scene);
  json polygons = json::array();
  for (const std::string& argument : a.silhouettes) {
    polygons.push_back({nef::utf8(argument), state_of(argument.substr(argument.find('=') + 1))});
  }
  return {{"version", NEF_VERSION},
          {"scene", nef::utf8(scene.string())},
          {"scene_content", state_of(scene)},
          {"simplify", a.simplify},
          {"outer", a.outer},
          {"manifold", a.session.mesh_file.manifold},
          {"lenient", a.session.mesh_file.lenient},
          {"recenter", a.session.mesh_file.recenter},
          {"color", a.color},
          {"texture", a.texture},
          {"min_area", a.min_area},
          {"soft", a.soft},
          {"border", a.border},
          {"box", a.box},
          {"pixel_origin", a.origin},
          {"up", a.up},
          {"matrices", a.matrices},
          {"turntable", {a.turntable.value_or(0), a.intrinsics, a.radius.value_or(0), a.height}},
          {"threshold", a.threshold},
          {"mask", a.mask},
          {"repair_masks", a.repair_masks},
          {"invert", a.invert},
          {"channel", a.channel},
          {"silhouettes", polygons},
          {"drop_suspects", a.drop_suspects},
          {"at_least", a.at_least},
          {"verify", a.verify},
          {"largest", a.largest},
          {"decimate", a.decimate},
          {"exact", a.session.exact},
          {"binary", a.session.binary},
          {"text", a.session.text}};
}

// What does not go with frames is refused.
const Arguments& checked(const Arguments& a) {
  const std::pair<const char*, bool> others[] = {{"--report", !a.session.report.empty()},
                                                 {"--json", a.session.json},
                                                 {"--overlay", !a.overlay.empty()},
                                                 {"--page", !a.page.empty()},
                                                 {"--picture", !a.picture.empty()},
                                                 {"--points", !a.points.empty()},
                                                 {"--hull-masks", !a.hull_masks.empty()},
                                                 {"--images", !a.images.empty()},
                                                 {"--without", !a.without.empty()},
                                                 {"--exact-volume", a.exact_volume},
                                                 {"--refine", a.refine},
                                                 {"--suspects", a.suspects}};
  for (const auto& [name, given] : others) {
    if (given) throw nef::InputError(std::string(name) + " is for one hull, not for --frames");
  }
  if (a.session.output.empty())
    throw nef::InputError("--frames needs -o, with a place for the number, as in hull_%04d.ply");
  return a;
}

// What a line of the manifest says.
json parse(const std::string& line) { return json::parse(line, nullptr, false); }

std::string of_frame(const json& entry, const std::string& text) {
  return fmt::format("frame {}: {}", entry["frame"].get<std::size_t>(), text);
}

// What the exit code is for a frame, which is complained of unless it is good.
int code_of(const json& entry, nef::Session& session) {
  const auto complain = [&](const std::string& word, const std::string& text) {
    session.complain(word + of_frame(entry, text));
  };
  if (entry.contains("warning")) complain("warning: ", entry["warning"]);
  const bool failed = entry["state"] == "failed";
  const bool empty = entry["state"] == "vanished" || !entry.value("inside", true);
  if (!failed && !empty) return 0;
  complain("", entry.value("message", "not inside its views"));
  return failed ? 2 : 1;
}

fs::path manifest_of(const NumberedPath& outputs) {
  return fs::path(outputs.with("manifest")).replace_extension(".jsonl");
}

json entry_of(const Result& result, const fs::path& output, const Arguments& a, const nef::Monitor& monitor) {
  nef::PolyhedronWriteOptions format = a.session.write_options(output.string());
  format.monitor = monitor;
  json entry;
  nef::Messages notes = result.notes;
  entry["state"] = result.vanished ? "vanished" : "done";
  if (result.vanished) {
    entry["message"] = nef::utf8(vanished_text(result));
  } else {
    const WrittenHull written = write_hull(output.string(), result, a, format, notes);
    if (written.decimated) entry["decimated"] = decimation_json(*written.decimated);
    if (!written.file.problem.empty()) entry["warning"] = nef::utf8(written.file.problem);
    if (!nef::is_zero(written.file.offset)) {
      for (const Rational& x : written.file.offset) entry["offset"].push_back(nef::to_string(x));
    }
    const nef::Counts counts = nef::counts(result.hull);
    entry["output"] = nef::utf8(output.string());
    entry["vertices"] = counts.vertices;
    entry["facets"] = counts.facets;
    entry["volume"] = nef::approximate_volume(result.hull, monitor).value;
  }
  for (const std::string& note : notes) entry["notes"].push_back(nef::utf8(note));
  for (const Dropped& dropped : result.dropped) entry["dropped"].push_back(nef::utf8(dropped.view));
  if (a.verify && !result.vanished) {
    entry["inside"] = std::all_of(result.views.begin(), result.views.end(), [](const ViewResult& view) {
      return view.verification && view.verification->inside;
    });
  }
  return entry;
}

}  // namespace

NumberedPath::NumberedPath(const std::string& pattern, const std::string& option) {
  const std::size_t percent = pattern.find('%');
  const std::size_t d = percent == std::string::npos ? percent : pattern.find_first_not_of("0123456789", percent + 1);
  const bool good = d != std::string::npos && pattern[d] == 'd' && pattern.find('%', d) == std::string::npos &&
                    d - percent <= 3 && (d == percent + 1 || pattern[percent + 1] == '0');
  if (!good) {
    throw nef::InputError(option + " " + nef::in_quotes(pattern) + ": one place for a number is needed: %d, or %04d " +
                          "with zeros in front");
  }
  before_ = pattern.substr(0, percent);
  after_ = pattern.substr(d + 1);
  if (d > percent + 1) width_ = std::stoul(pattern.substr(percent + 1, d - percent - 1));
}

fs::path NumberedPath::with(const std::string& word) const { return before_ + word + after_; }

std::string NumberedPath::digits(std::size_t number) const { return fmt::format("{:0{}}", number, width_); }

std::vector<std::size_t> NumberedPath::existing() const {
  const fs::path folder = fs::path(before_).parent_path();
  const std::string start = fs::path(before_).filename().string();
  std::vector<std::size_t> numbers;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start)) continue;
    const std::size_t end = std::min(name.find_first_not_of("0123456789", start.size()), name.size());
    const std::string digits_found = name.substr(start.size(), end - start.size());
    if (digits_found.empty() || digits_found.size() > 9) continue;
    const std::size_t number = std::stoul(digits_found);
    if (digits(number) == digits_found && fs::exists(of(number), error)) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

FrameTasks::FrameTasks(const Arguments& a)
    : arguments_(checked(a)), folders_(a.frames, "--frames"), outputs_(a.session.output, "-o") {
  frames_ = folders_.existing();
  if (frames_.empty()) throw nef::InputError("--frames " + a.frames + ": there is no such folder");
  Scene scene = scene_of(a);
  scene.image_folders.clear();  // an image that a frame lacks is not to be taken from another place
  understanding_ = understood(scene);
  Options options = to_options(a);
  stream_ = std::make_unique<const HullStream>(std::move(scene), options);
}

std::string FrameTasks::make(std::size_t task, const nef::Monitor& monitor) const {
  const fs::path folder = this->folder(task);
  json entry{{"frame", frames_[task]}, {"images", nef::utf8(folder.string())}, {"images_state", state_of(folder)}};
  const nef::ThreadStopwatch watch;
  try {
    const Result result = stream_->frame(folder, std::nullopt, monitor);
    entry.update(entry_of(result, outputs_.of(frames_[task]), arguments_, monitor));
  } catch (const nef::Error& error) {
    entry.update(json{{"state", "failed"}, {"message", nef::utf8(error.what())}});
  }
  entry["total_s"] = watch.seconds();
  return entry.dump();
}

// What was made, by frame.
class FrameRecord::Manifest {
 public:
  Manifest(fs::path file, json settings) : file_(std::move(file)) {
    std::ifstream old(file_);
    std::string line;
    const bool same = std::getline(old, line) && parse(line) == json{{"settings", settings}};
    while (same && std::getline(old, line)) {
      const json entry = parse(line);  // the last line of a run that was killed may be cut
      if (entry.is_object() && entry.contains("frame") && entry["frame"].is_number_unsigned()) {
        lines_[entry["frame"].get<std::size_t>()] = entry;
      }
    }
    old.close();
    first_line_ = json{{"settings", std::move(settings)}}.dump();
    rewrite();
    stream_.open(file_, std::ios::app);
  }

  [[nodiscard]] bool has(std::size_t frame, const std::string& images) const {
    const auto found = lines_.find(frame);
    if (found == lines_.end()) return false;
    const json& entry = found->second;
    if (entry.value("images_state", "") != images || entry.value("state", "") == "failed") return false;
    std::error_code error;
    return entry.value("state", "") != "done" || fs::is_regular_file(entry.value("output", ""), error);
  }

  [[nodiscard]] const json& line(std::size_t frame) const { return lines_.at(frame); }

  void add(json entry) {
    stream_ << entry.dump() << "\n" << std::flush;
    if (!stream_) throw nef::InputError(file_.string() + ": cannot be written");
    const auto frame = entry["frame"].get<std::size_t>();  // before the entry is moved from
    lines_[frame] = std::move(entry);
  }

  // In the order of the frames, each once.
  void rewrite() const {
    std::string text = first_line_ + "\n";
    for (const auto& [frame, entry] : lines_) text += entry.dump() + "\n";
    nef::write_file(file_.string(), text);
  }

 private:
  fs::path file_;
  std::string first_line_;
  std::map<std::size_t, json> lines_;
  std::ofstream stream_;
};

FrameRecord::FrameRecord(const Arguments& a, const FrameTasks& tasks)
    : tasks_(tasks),
      session_(a.session),
      file_(manifest_of(NumberedPath(a.session.output, "-o"))),
      manifest_(std::make_unique<Manifest>(file_, settings_of(a))) {}

FrameRecord::~FrameRecord() = default;

bool FrameRecord::keep(std::size_t task) {
  const std::size_t frame = tasks_.number(task);
  if (!manifest_->has(frame, state_of(tasks_.folder(task)))) return false;
  ++kept_;
  ++done_;
  code_ = std::max(code_, code_of(manifest_->line(frame), session_));
  return true;
}

void FrameRecord::add(const std::string& line) {
  json entry = parse(line);
  ++done_;
  code_ = std::max(code_, code_of(entry, session_));
  if (!noted_ && entry.contains("notes")) {  // all frames have the same names, as a rule
    noted_ = true;
    nef::Messages notes;
    for (const auto& note : entry["notes"]) notes.push_back(of_frame(entry, note));
    session_.note_all(notes);
  }
  manifest_->add(std::move(entry));
}

int FrameRecord::finish() {
  manifest_->rewrite();
  session_.say(fmt::format("{} frames, {} of them made before; manifest: {}", tasks_.size(), kept_, file_.string()));
  return code_;
}

int make_frames(const Arguments& a) {
  const FrameTasks tasks(a);
  a.session.say(tasks.understanding());
  FrameRecord record(a, tasks);
  std::mutex recording;
  const auto recorded = [&](const auto& change) {
    const std::lock_guard<std::mutex> lock(recording);
    const bool done = change();
    if (done) a.session.show_phase("frame", record.done(), tasks.size());
    return done;
  };
  nef::parallel_for(tasks.size(), a.session.monitor.quiet(), [&](std::size_t i, const nef::Monitor& own) {
    if (recorded([&] { return record.keep(i); })) return;
    const std::string line = tasks.make(i, own);
    recorded([&] {
      record.add(line);
      return true;
    });
  });
  return record.finish();
}

}  // namespace nef::visual_hull
