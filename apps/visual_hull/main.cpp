// SPDX-License-Identifier: Apache-2.0
//
// visual_hull SCENE [options]: the exact visual hull of calibrated silhouettes.
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "apps/visual_hull/command/run.h"
#include "nef/program/run_program.h"

int main(int argc, char** argv) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // errors are ours to tell
  cv::setNumThreads(1);                                                   // threads have whole views to work on
  visual_hull::Arguments arguments;
  CLI::App app{
      "Exact visual hulls from calibrated silhouettes: a closed solid, in rational numbers, without tolerance."};
  visual_hull::add_options(app, arguments);
  return nef::run_program(app, argc, argv, [&arguments] { return visual_hull::run(arguments); });
}
