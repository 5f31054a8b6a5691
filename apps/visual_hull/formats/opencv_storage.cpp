// SPDX-License-Identifier: Apache-2.0
//
// OpenCV parses the file; this reader finds the cameras in it. Names are reduced to plain spelling and mapped to a
// meaning (K, D, R, t, P, ...), with a number at the end for the view. Nodes without a number are common to all views.
// What looks like a lens under an unknown name is refused, since a lens that is left out makes the hull slightly wrong
// without a sign.
#include "apps/visual_hull/formats/opencv_storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "apps/visual_hull/formats/foreign_parser.h"
#include "apps/visual_hull/scene/natural_order.h"
#include "apps/visual_hull/scene/pose.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

using Matrix34d = Eigen::Matrix<double, 3, 4>;

std::string plain(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (c != '_') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

// What a name stands for, in plain spelling.
const std::map<std::string, std::string>& meanings() {
  static const std::map<std::string, std::string> kNames{{"k", "K"},
                                                         {"cameramatrix", "K"},
                                                         {"mtx", "K"},
                                                         {"intrinsics", "K"},
                                                         {"intrinsicmatrix", "K"},
                                                         {"m", "K"},
                                                         {"d", "D"},
                                                         {"distortioncoefficients", "D"},
                                                         {"distortioncoeffs", "D"},
                                                         {"distortionparameters", "D"},
                                                         {"distcoeffs", "D"},
                                                         {"dist", "D"},
                                                         {"distortion", "D"},
                                                         {"p", "P"},
                                                         {"projectionmatrix", "P"},
                                                         {"projection", "P"},
                                                         {"r", "R"},
                                                         {"rotation", "R"},
                                                         {"rotationmatrix", "R"},
                                                         {"rotationvector", "R"},
                                                         {"rvec", "R"},
                                                         {"t", "t"},
                                                         {"translation", "t"},
                                                         {"translationvector", "t"},
                                                         {"tvec", "t"},
                                                         {"extrinsicparameters", "extrinsics"},
                                                         {"extrinsics", "extrinsics"},
                                                         {"imagewidth", "width"},
                                                         {"width", "width"},
                                                         {"imageheight", "height"},
                                                         {"height", "height"},
                                                         {"image", "image"},
                                                         {"imagename", "image"},
                                                         {"file", "image"},
                                                         {"filename", "image"},
                                                         {"filepath", "image"},
                                                         {"name", "name"},
                                                         {"cameras", "list"},
                                                         {"views", "list"},
                                                         {"frames", "list"}};
  return kNames;
}

std::string meaning(const std::string& name) {
  const auto found = meanings().find(plain(name));
  return found == meanings().end() ? "" : found->second;
}

// All numbers of a node: a matrix, a sequence or a number.
cv::Mat matrix_of(const cv::FileNode& node) {
  cv::Mat result;
  if (node.isMap()) {
    cv::Mat stored;
    node >> stored;
    if (!stored.empty()) stored.reshape(1).convertTo(result, CV_64F);
  } else if (node.isSeq()) {
    std::vector<double> values;
    std::size_t rows = 0;
    for (const cv::FileNode& item : node) {
      if (item.isSeq()) {
        ++rows;
        for (const cv::FileNode& inner : item) {
          if (inner.isInt() || inner.isReal()) values.push_back(inner.real());
        }
      } else if (item.isInt() || item.isReal()) {
        values.push_back(item.real());
      }
    }
    if (!values.empty()) result = cv::Mat(values, true).reshape(1, static_cast<int>(std::max<std::size_t>(rows, 1)));
  }
  return result;
}

// What is known of one view, by meaning.
using Parts = std::map<std::string, cv::FileNode>;

class StorageReader {
 public:
  StorageReader(const std::string& content, const std::filesystem::path& file, std::string matrices)
      : file_(file.string()), matrices_(std::move(matrices)) {
    try {
      storage_.open(content, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    } catch (const cv::Exception& error) {
      throw nef::InputError(file_ + ": not a file of OpenCV's FileStorage (" + error.err + ")");
    }
    if (!storage_.isOpened()) throw nef::InputError(file_ + ": not a file of OpenCV's FileStorage");
  }

  Scene read() {
    scene_.format = "OpenCV FileStorage (world to camera, y down)";
    scene_.origin = PixelOrigin::kCenter;
    const cv::FileNode root = storage_.root();
    if (!matrices_.empty()) {
      add_matrices(root);
    } else {
      sort_nodes(root);
      add_views();
      if (scene_.views.empty()) add_counted_matrices(root);
    }
    if (scene_.views.empty()) {
      std::string names;
      for (const cv::FileNode& node : root) names += (names.empty() ? "" : ", ") + node.name();
      throw nef::InputError(file_ + ": there is no camera that is understood among " + names +
                            "; name its matrices with --matrices, as in --matrices 'world_mat_*'");
    }
    return std::move(scene_);
  }

 private:
  // A lens that is left out unnoticed would make the hull a little wrong.
  void refuse_other_distortion(const std::string& name) const {
    if (plain(name).rfind("dist", 0) != 0 || plain(name).rfind("distance", 0) == 0) return;
    throw nef::InputError(fmt::format(
        "{}: {} is not understood; lens distortion is called distortion_coefficients, dist_coeffs, dist or D", file_,
        nef::in_quotes(name)));
  }

  // R1 and R01 are of one view, so one of them would be lost.
  void refuse_equal_numbers(const std::string& earlier, const std::string& name, std::size_t digits) const {
    if (earlier.empty() || earlier.find_last_not_of("0123456789") != digits - 1) return;
    if (plain(earlier.substr(0, digits)) != plain(name.substr(0, digits))) return;
    throw nef::InputError(fmt::format("{}: {} and {} have the same number: rename one of them", file_,
                                      nef::in_quotes(earlier), nef::in_quotes(name)));
  }

  // Digits without leading zeros.
  static std::string number_of(const std::string& digits) {
    return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  }

  void sort_nodes(const cv::FileNode& root) {
    for (const cv::FileNode& node : root) {
      const std::string name = node.name();
      if (const std::string what = meaning(name); !what.empty()) {
        common_[what] = node;
        continue;
      }
      std::size_t digits = name.size();
      while (digits > 0 && std::isdigit(static_cast<unsigned char>(name[digits - 1])) != 0) --digits;
      const std::string what = meaning(name.substr(0, digits));
      const bool numbered = digits != name.size() && digits != 0;
      if (numbered && !what.empty() && what != "list") {
        cv::FileNode& part = numbered_[number_of(name.substr(digits))][what];
        refuse_equal_numbers(part.empty() ? "" : part.name(), name, digits);
        part = node;
      } else {
        refuse_other_distortion(name);
      }
    }
  }

  void add_views() {
    if (common_.count("list") != 0 && common_["list"].isSeq()) {
      for (const cv::FileNode& entry : common_["list"]) {
        Parts parts;
        for (const cv::FileNode& node : entry) {
          const std::string what = meaning(node.name());
          if (what.empty()) refuse_other_distortion(node.name());
          if (!what.empty()) parts[what] = node;
        }
        add_view(parts, std::to_string(scene_.views.size() + 1));
      }
    } else if (common_.count("extrinsics") != 0) {
      add_rows(matrix_of(common_["extrinsics"]));
    } else if (!numbered_.empty()) {
      for (const auto& [number, parts] : numbered_) {
        const bool camera = parts.count("P") != 0 || parts.count("R") != 0 || parts.count("t") != 0;
        if (camera) add_view(parts, number);
      }
    } else if (common_.count("P") != 0 || common_.count("R") != 0) {
      add_view({}, std::filesystem::path(file_).stem().string());
    }
  }

  [[nodiscard]] cv::FileNode find(const Parts& parts, const std::string& what) const {
    if (const auto own = parts.find(what); own != parts.end()) return own->second;
    const auto shared = common_.find(what);
    return shared == common_.end() ? cv::FileNode() : shared->second;
  }

  [[nodiscard]] cv::Mat numbers(const Parts& parts, const std::string& what, std::vector<std::size_t> counts,
                                const std::string& view) const {
    const cv::Mat m = matrix_of(find(parts, what));
    if (std::find(counts.begin(), counts.end(), m.total()) != counts.end()) return m.reshape(1, 1);
    std::string wanted;
    for (const std::size_t count : counts) wanted += (wanted.empty() ? "" : " or ") + std::to_string(count);
    throw nef::InputError(
        fmt::format("{}, view {}, {}: {} numbers are needed, not {}", file_, view, what, wanted, m.total()));
  }

  void add_view(const Parts& parts, const std::string& fallback) {
    const std::string image = text(find(parts, "image"));
    std::string name = text(find(parts, "name"));
    if (name.empty()) name = image.empty() ? fallback : image;
    if (!find(parts, "P").empty()) {
      const cv::Mat p = numbers(parts, "P", {12, 16}, name);
      scene_.views.push_back(make_view(name, first_rows(p)));
    } else {
      const cv::Mat t = numbers(parts, "t", {3}, name);
      Pose pose{rotation_of(numbers(parts, "R", {3, 9}, name)), {}};
      for (int i = 0; i < 3; ++i) pose.translation[i] = t.at<double>(i);
      scene_.views.push_back(make_view(name, lens_of(parts, name), pose));
    }
    scene_.views.back().image = image;
  }

  // The calibration sample's rows: rvec and tvec, or R and t.
  void add_rows(const cv::Mat& rows) {
    if (rows.cols != 6 && rows.cols != 12) {
      throw nef::InputError(
          fmt::format("{}, extrinsic_parameters: rows of 6 (rvec, tvec) or 12 numbers (R, t) are "
                      "needed, not {}",
                      file_, rows.cols));
    }
    for (int i = 0; i < rows.rows; ++i) {
      const std::string name = std::to_string(i + 1);
      const int turn = rows.cols - 3;
      Pose pose{rotation_of(rows.row(i).colRange(0, turn).clone()), {}};
      for (int k = 0; k < 3; ++k) pose.translation[k] = rows.at<double>(i, turn + k);
      scene_.views.push_back(make_view(name, lens_of({}, name), pose));
    }
  }

  [[nodiscard]] Lens lens_of(const Parts& parts, const std::string& view) const {
    const cv::Mat k = numbers(parts, "K", {9}, view);
    if (k.at<double>(1) != 0 || k.at<double>(3) != 0) {
      throw nef::InputError(
          fmt::format("{}, view {}: a skew of {} is not a lens; give P", file_, view, k.at<double>(1)));
    }
    Lens lens;
    lens.fx = k.at<double>(0);
    lens.fy = k.at<double>(4);
    lens.cx = k.at<double>(2);
    lens.cy = k.at<double>(5);
    if (!find(parts, "D").empty()) {
      const cv::Mat d = numbers(parts, "D", {4, 5, 8, 12, 14}, view);
      lens.distortion.assign(d.begin<double>(), d.end<double>());
    }
    const cv::FileNode width = find(parts, "width");
    const cv::FileNode height = find(parts, "height");
    if (width.isInt() && height.isInt()) lens.size = ImageSize{static_cast<int>(width), static_cast<int>(height)};
    return lens;
  }

  static std::string text(const cv::FileNode& node) { return node.isString() ? node.string() : std::string(); }

  static Eigen::Matrix3d rotation_of(const cv::Mat& numbers) {
    cv::Mat turn = numbers.reshape(1, 1);
    if (turn.total() == 3) {
      cv::Mat matrix;
      cv::Rodrigues(turn, matrix);
      turn = matrix.reshape(1, 1);
    }
    Eigen::Matrix3d r;
    for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = turn.at<double>(i);
    return r;
  }

  static Matrix34d first_rows(const cv::Mat& row_major) {
    const cv::Mat flat = row_major.reshape(1, 1);
    Matrix34d p;
    for (int i = 0; i < 12; ++i) p(i / 4, i % 4) = flat.at<double>(i);
    return p;
  }

  // A rotation and a translation, of which nobody knows the lens.
  static bool is_pose(const Matrix34d& m) {
    const Eigen::Matrix3d left = m.leftCols<3>();
    return (left * left.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3;
  }

  // Projection matrices by the names of one word with a number in it, as in viff000_matrix, viff001_matrix, ...
  void add_counted_matrices(const cv::FileNode& root) {
    std::string pattern;
    for (const cv::FileNode& node : root) {
      const std::string name = node.name();
      const std::size_t first = name.find_first_of("0123456789");
      if (first == std::string::npos) continue;
      const std::size_t end = std::min(name.find_first_not_of("0123456789", first), name.size());
      const std::string after = plain(name.substr(end));
      const cv::Mat m = matrix_of(node);
      if ((after != "matrix" && meaning(after) != "P") || m.rows != 3 || m.total() != 12 || is_pose(first_rows(m)))
        continue;
      const std::string own = name.substr(0, first) + "*" + name.substr(end);
      if (!pattern.empty() && own != pattern) return;  // several kinds: --matrices tells
      pattern = own;
    }
    if (pattern.empty()) return;
    matrices_ = pattern;
    add_matrices(root);
  }

  // All matrices whose names fit the pattern.
  void add_matrices(const cv::FileNode& root) {
    const std::size_t star = matrices_.find('*');
    const std::string before = matrices_.substr(0, star);
    const std::string after = star == std::string::npos ? "" : matrices_.substr(star + 1);
    struct Found {
      std::string key;
      cv::Mat matrix;
    };
    std::vector<Found> found;
    for (const cv::FileNode& node : root) {
      const std::string name = node.name();
      const bool fits = star == std::string::npos
                            ? name == matrices_
                            : name.size() >= before.size() + after.size() && name.rfind(before, 0) == 0 &&
                                  name.compare(name.size() - after.size(), after.size(), after) == 0;
      if (!fits) continue;
      const cv::Mat m = matrix_of(node);
      if (m.total() != 12 && m.total() != 16) {
        throw nef::InputError(fmt::format("{}, {}: a matrix of 3x4 or 4x4 numbers is needed", file_, name));
      }
      const std::size_t middle = name.size() - before.size() - after.size();
      found.push_back({star == std::string::npos ? name : name.substr(before.size(), middle), m});
    }
    // Numbers in their order: 10 after 9.
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return naturally_before(a.key, b.key); });
    for (const Found& f : found) scene_.views.push_back(make_view(f.key, first_rows(f.matrix)));
  }

  std::string file_;
  std::string matrices_;
  cv::FileStorage storage_;
  Parts common_;
  std::map<std::string, Parts, decltype(&naturally_before)> numbered_{&naturally_before};  // by number_of
  Scene scene_;
};

}  // namespace

bool is_opencv_storage(const std::string& text) {
  return text.rfind("%YAML", 0) == 0 || text.substr(0, 400).find("<opencv_storage>") != std::string::npos;
}

Scene read_opencv_storage(const std::string& text, const std::filesystem::path& file, const std::string& matrices) {
  return read_with_limits(file, "OpenCV", text.size(), [&] {
    try {
      return StorageReader(text, file, matrices).read();
    } catch (const cv::Exception& error) {
      throw nef::InputError(file.string() + ": " + error.err);
    }
  });
}

}  // namespace nef::visual_hull
