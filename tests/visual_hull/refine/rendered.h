// SPDX-License-Identifier: Apache-2.0
//
// Rendered sets of which everything is known: unions of ellipsoids, whose outlines are decided pixel by pixel by a
// quadratic form, seen by cameras that can be disturbed.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/pose.h"
#include "apps/visual_hull/silhouette/silhouette.h"

namespace nef::visual_hull::testing {

using Matrix34d = Eigen::Matrix<double, 3, 4>;

/// { c + B x : |x| <= 1 }.
struct Ellipsoid {
  Eigen::Vector3d centre;
  Eigen::Matrix3d form;  ///< (B B^T)^-1
};

/// A union of ellipsoids within about the unit ball that looks like nothing in particular.
inline std::vector<Ellipsoid> generic_object(std::uint64_t seed, int parts = 6) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> from(-1, 1);
  std::vector<Ellipsoid> object;
  for (int k = 0; k < parts; ++k) {
    const Eigen::Vector3d centre = 0.55 * Eigen::Vector3d(from(random), from(random), from(random));
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(from(random), from(random), from(random), from(random)).normalized();
    const Eigen::Vector3d axes =
        Eigen::Vector3d::Constant(0.28) + 0.17 * Eigen::Vector3d(from(random), from(random), from(random));
    const Eigen::Matrix3d r = turn.toRotationMatrix();
    object.push_back({centre, r * axes.cwiseProduct(axes).cwiseInverse().asDiagonal() * r.transpose()});
  }
  return object;
}

/// K [R | t] with square pixels.
struct Shot {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  [[nodiscard]] Matrix34d matrix() const {
    Matrix34d pose;
    pose << r, t;
    return k * pose;
  }
  [[nodiscard]] Eigen::Vector2d seen(const Eigen::Vector3d& p) const { return (k * (r * p + t)).hnormalized(); }
};

inline constexpr int kWidth = 480;
inline constexpr int kHeight = 400;

/// A camera at `from` that looks at the origin, upright; focal length in pixels.
inline Shot look(const Eigen::Vector3d& from, double focal) {
  Shot shot;
  const Eigen::Vector3d ahead = -from.normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  shot.k << focal, 0, (kWidth - 1) / 2.0, 0, focal, (kHeight - 1) / 2.0, 0, 0, 1;
  shot.r << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  shot.t = -shot.r * from;
  return shot;
}

/// Cameras around the object, at three heights or, of a turntable, at one.
inline std::vector<Shot> ring(int count, bool turntable, double focal = 550, double distance = 4) {
  std::vector<Shot> shots;
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2 * M_PI * i / count;
    const double elevation =
        (turntable ? 20 : std::array<double, 3>{20, 50, -15}[static_cast<std::size_t>(i % 3)]) * M_PI / 180;
    shots.push_back(look(distance * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation)),
                         focal));
  }
  return shots;
}

/// 255 where the ray through the centre of a pixel meets the object. Along a row of pixels, what is compared is a
/// quadratic function of x.
inline cv::Mat render(const std::vector<Ellipsoid>& object, const Shot& shot) {
  cv::Mat mask(kHeight, kWidth, CV_8U, cv::Scalar(0));
  const Eigen::Vector3d eye = -shot.r.transpose() * shot.t;
  const Eigen::Matrix3d back = (shot.k * shot.r).inverse();
  const Eigen::Vector3d step = back.col(0);
  for (const Ellipsoid& e : object) {
    const Eigen::Vector3d a = e.form * (eye - e.centre);
    const double c = (eye - e.centre).dot(a) - 1;
    const double b1 = step.dot(a);
    const double q2 = step.dot(e.form * step);
    for (int y = 0; y < kHeight; ++y) {
      const Eigen::Vector3d first = back * Eigen::Vector3d(0, y, 1);
      const double b0 = first.dot(a);
      const double q0 = first.dot(e.form * first);
      const double q1 = 2 * step.dot(e.form * first);
      auto* const row = mask.ptr<std::uint8_t>(y);
      for (int x = 0; x < kWidth; ++x) {
        const double b = b0 + x * b1;
        if (b < 0 && b * b >= c * (q0 + x * (q1 + x * q2))) row[x] = 255;
      }
    }
  }
  return mask;
}

/// Cameras as a calibration of some error gives them: each turned by `degrees` about the object and shifted by `pixels`
/// in its image, in random directions; the focal length of all times `focal`.
inline std::vector<Shot> disturbed(std::vector<Shot> shots, double degrees, double pixels, double focal,
                                   std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (Shot& shot : shots) {
    const Eigen::Vector3d axis = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    shot.r = shot.r * Eigen::AngleAxisd(degrees * M_PI / 180, axis).toRotationMatrix();
    const double angle = 2 * M_PI * std::uniform_real_distribution<double>(0, 1)(random);
    shot.t.head<2>() += pixels * shot.t.z() / shot.k(0, 0) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    shot.k(0, 0) *= focal;
    shot.k(1, 1) *= focal;
  }
  return shots;
}

/// A camera that stands off: turned by a degree about an axis that the seed says, or shifted by two pixels.
inline Shot standing_off(Shot shot, bool turned, std::uint64_t seed) {
  if (turned) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, static_cast<double>(seed)).normalized();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 180, axis).toRotationMatrix();
    shot.r = turn * shot.r;
    shot.t = turn * shot.t;
  } else {
    shot.t.x() += 2 * shot.t.z() / shot.k(0, 0);
  }
  return shot;
}

/// Views of a set, with silhouettes along the sides of pixels.
struct Set {
  std::vector<Shot> truth;
  std::vector<cv::Mat> masks;
  std::vector<Silhouette> silhouettes;
};

inline Silhouette pixel_silhouette(const cv::Mat& mask) {
  return silhouette_of_mask(mask, {}, "test", SilhouetteOptions{}).region;
}

/// Takes the lowest rows of a mask away, up to a share of its pixels.
inline void cut_lowest(Set& set, std::size_t view, double share) {
  cv::Mat& mask = set.masks[view];
  double left = (1 - share) * cv::countNonZero(mask);
  for (int y = 0; y < mask.rows; ++y) {
    const int in_row = cv::countNonZero(mask.row(y));
    if (left < 0) mask.row(y).setTo(0);
    left -= in_row;
  }
  set.silhouettes[view] = pixel_silhouette(mask);
}

inline Set rendered_set(const std::vector<Ellipsoid>& object, const std::vector<Shot>& shots) {
  Set set;
  set.truth = shots;
  for (const Shot& shot : shots) {
    set.masks.push_back(render(object, shot));
    set.silhouettes.push_back(pixel_silhouette(set.masks.back()));
  }
  return set;
}

}  // namespace nef::visual_hull::testing
