// SPDX-License-Identifier: Apache-2.0
//
// Masks by graph cuts between mixtures of colours: GrabCut (Rother, Kolmogorov and Blake 2004).
#pragma once

#include <opencv2/core.hpp>

namespace nef::visual_hull {

/// The part of a picture within margins of 5 %, where an object that nobody has marked is.
cv::Rect inside_margins(const cv::Size& size);

/// The object in a rectangle of a picture (three channels of 8 bits), whose outside is background. Large pictures are
/// cut at 800 pixels first and then in a band along that outline. 255 where the object is; the same for the same input.
cv::Mat cut_in_rectangle(const cv::Mat& picture, const cv::Rect& rectangle);

/// The object of a picture by seeds as `cut_by_seeds` has them, of some strokes of a person: of the components of what
/// is cut those that a sure seed says are object. Large pictures as with `cut_in_rectangle`. 255 where the object is;
/// the same for the same input. Seeds have the size of the picture.
cv::Mat cut_by_strokes(const cv::Mat& picture, const cv::Mat& seeds);

/// Decides pixels by seeds (cv::GC_FGD, GC_BGD: sure; GC_PR_FGD, GC_PR_BGD: likely, to be decided). Without sure pixels
/// of both kinds likely ones are what they are likely to be. 255 where the object is; the same for the same input.
cv::Mat cut_by_seeds(const cv::Mat& picture, const cv::Mat& seeds);

}  // namespace nef::visual_hull
