// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/findings.h"

#include <iostream>

#include "apps/view/glb.h"
#include "apps/view/page.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {

bool is_view_file(const std::string& file) {
  const std::string extension = lower_extension(file);
  return extension == "html" || extension == "glb";
}

void tell(const Arguments& a, const Findings& findings) {
  a.session.hide_phase();
  std::string report;  // made once
  const auto report_of_run = [&]() -> const std::string& {
    if (report.empty()) {
      report = report_text(run_report(findings.command, findings.report(), findings.phases, a.session.notes()));
    }
    return report;
  };
  std::vector<std::string> views;
  if (!a.page.empty()) views.push_back(a.page);
  for (const std::string& file : a.outputs) {
    const std::string extension = lower_extension(file);
    if (extension == "json") {
      write_file(file, report_of_run());
    } else if (findings.layers && is_view_file(file)) {
      views.push_back(file);
    } else if (const auto text = findings.text ? findings.text(extension) : std::nullopt) {
      write_file(file, *text);
    }
  }
  if (!views.empty() && findings.layers) {
    const std::vector<view::Layer> layers = findings.layers();
    view::PageOptions options;
    options.title = findings.title;
    for (const std::string& file : views) {
      if (lower_extension(file) == "glb") {
        view::write_glb(layers, file);
      } else {
        view::write_page(layers, file, options);
      }
    }
  }
  if (a.session.json) {
    std::cout << report_of_run();
  } else if (!a.session.quiet) {
    findings.for_people();
  }
}

}  // namespace nef::planner
