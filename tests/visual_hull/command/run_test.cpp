// SPDX-License-Identifier: Apache-2.0
//
// The command as a user runs it, on the data that comes with the project.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/visual_hull/command/report.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/version.h"
#include "tests/support/paths.h"
#include "tests/support/report_shape.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using Catch::StartsWith;
using testing::Outcome;
using testing::run;
using testing::Scratch;

std::string data(const std::string& name) { return source_folder() + "/data/visual_hull/" + name; }

nlohmann::json read_json(const std::filesystem::path& file) {
  return nlohmann::json::parse(nef::read_file(file.string()));
}

TEST_CASE("Three letters: output, report and verification") {
  const Scratch s;
  const std::string off = (s.folder() / "hull.off").string();
  const std::string nef = (s.folder() / "hull.nef").string();
  const std::string report = (s.folder() / "report.json").string();
  const Outcome outcome = run(data("letters/nef.vsh") + " -o " + nef + " --verify --exact-volume --report " + report +
                              " --overlay " + (s.folder() / "views").string());
  INFO(outcome.output);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.output.find('\r') == std::string::npos);  // no bar in a pipe
  CHECK(outcome.output.find('\x1b') == std::string::npos);
  const nlohmann::json r = read_json(report);
  REQUIRE(r["views"].size() == 3);
  CHECK(r["views"][0]["contours"] == 1);
  CHECK(r["views"][0]["holes"] == 0);
  CHECK(r["views"][0]["polygon_vertices"] == 10);
  CHECK(r["views"][0]["cone_facets"] == 12);  // ten sides and two caps
  for (const char* phase : {"load", "contours", "cones", "intersection", "verify", "write"}) {
    CHECK(r["phases"].contains(phase + std::string("_s")));
    CHECK(r["predicates_by_phase"].contains(phase));
  }
  nef::test::check_report_shape(r, "hull");
  // CGAL 5.5 intersecting the same three cones gives the same counts (bench/visual_hull).
  CHECK(r["result"]["vertices"] == 101);
  CHECK(r["result"]["facets"] == 67);
  CHECK(r["result"]["closed"] == true);
  CHECK(r["result"]["bounded"] == true);
  REQUIRE(r["verify"].size() == 3);
  for (const auto& view : r["verify"]) CHECK(view["inside"] == true);
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(s.folder() / "views")) {
    CHECK_FALSE(cv::imread(entry.path().string()).empty());
    ++pictures;
  }
  CHECK(pictures == 3);
  const nef::Polyhedron hull = nef::read_polyhedron(nef);
  CHECK(nef::to_string(nef::volume(hull).value()) == r["result"]["volume"]);
  CHECK(run(data("letters/nef.vsh") + " -q -o " + off).output.empty());
  CHECK(std::filesystem::exists(off));
}

// The volume of the voxels whose centres project into all masks, in double precision.
double voxel_volume(const Scene& scene, const std::string& folder, const WorldBox& box, int steps) {
  std::vector<cv::Mat> masks;
  std::vector<std::array<std::array<double, 4>, 3>> p;
  for (const View& view : scene.views) {
    masks.push_back(cv::imread(find_image(folder, view.image.string()).string(), cv::IMREAD_GRAYSCALE));
    p.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) p.back()[i][j] = nef::nearest_double(view.camera.matrix()[i][j]);
    }
  }
  std::array<double, 3> low{};
  std::array<double, 3> step{};
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = nef::nearest_double(box.low[i]);
    step[i] = (nef::nearest_double(box.high[i]) - low[i]) / steps;
  }
  std::size_t count = 0;
  for (int a = 0; a < steps; ++a) {
    for (int b = 0; b < steps; ++b) {
      for (int c = 0; c < steps; ++c) {
        const std::array<double, 3> x{low[0] + (a + 0.5) * step[0], low[1] + (b + 0.5) * step[1],
                                      low[2] + (c + 0.5) * step[2]};
        bool in = true;
        for (std::size_t v = 0; v < masks.size() && in; ++v) {
          std::array<double, 3> q{};
          for (std::size_t i = 0; i < 3; ++i)
            q[i] = p[v][i][0] * x[0] + p[v][i][1] * x[1] + p[v][i][2] * x[2] + p[v][i][3];
          const int u = static_cast<int>(std::lround(q[0] / q[2]));
          const int w = static_cast<int>(std::lround(q[1] / q[2]));
          in = u >= 0 && w >= 0 && u < masks[v].cols && w < masks[v].rows && masks[v].at<std::uint8_t>(w, u) != 0;
        }
        count += in ? 1 : 0;
      }
    }
  }
  return static_cast<double>(count) * step[0] * step[1] * step[2];
}

TEST_CASE("Rendered silhouettes agree with their voxel hull, and every view with the hull") {
  const std::string model = "eight";
  const Scratch s;
  const std::string report = (s.folder() / "report.json").string();
  const Outcome outcome = run(data(model + "/" + model + ".json") + " --simplify 0.75 --verify --report " + report);
  INFO(outcome.output);
  REQUIRE(outcome.code == 0);
  CHECK_THAT(outcome.output, Contains("box found: --box="));
  const nlohmann::json r = read_json(report);
  std::size_t holes = 0;
  for (const auto& view : r["views"]) holes += view["holes"].get<std::size_t>();
  CHECK(holes >= 4);
  WorldBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = nef::parse_rational(r["box"][i].get<std::string>());
    box.high[i] = nef::parse_rational(r["box"][3 + i].get<std::string>());
  }
  const Scene scene = read_scene(data(model + "/" + model + ".json"));
  const double voxels = voxel_volume(scene, data(model), box, 100);
  CHECK(r["result"]["volume_double"].get<double>() == Approx(voxels).epsilon(0.02));
  // The figure eight has two holes, and the largest piece of the hull keeps them.
  CHECK(r["result"]["euler_numbers"][0] == -2);
}

TEST_CASE("An outer hull contains the hull of the full contours") {
  const Scene scene = read_scene(data("eight/eight.json"));
  Scene few = scene;
  few.views.resize(3);
  Options full;
  const Result exact = compute(few, data("eight"), full);
  Options outer;
  outer.silhouette.simplify = {1.5, true};
  outer.box = exact.box;
  const Result loose = compute(few, data("eight"), outer);
  CHECK(testing::subset(exact.hull, loose.hull));
  for (std::size_t i = 0; i < few.views.size(); ++i) {
    CHECK(loose.views[i].silhouette.region.vertex_count() * 2 < exact.views[i].silhouette.region.vertex_count());
  }
}

TEST_CASE("Bad use and bad input: one line, exit code 2") {
  const Scratch s;
  const auto fails = [](const Outcome& outcome, const std::string& part) {
    INFO(outcome.output);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.output, Contains(part));
    CHECK(std::count(outcome.output.begin(), outcome.output.end(), '\n') == 1);
  };
  fails(run(""), "SCENE is required");
  fails(run("mask photographs"), "no subcommand or file 'mask'; did you mean 'masks'?");
  fails(run("nowhere.json"), "no such file");
  fails(run(data("eight/eight_00.png")), "not a scene; give a scene file, or a folder of images");
  fails(run(s.folder().string()), "is a directory");
  fails(run(data("letters/nef.vsh") + " --simplify -3"), "--simplify");
  fails(run(data("letters/nef.vsh") + " --border maybe"), "--border");
  fails(run(data("letters/nef.vsh") + " --box 0,0,0,1,1"), "six numbers");
  fails(run(data("letters/nef.vsh") + " --box 0,0,0,0,1,1"), "flat along x");
  fails(run(data("letters/nef.vsh") + " --frobnicate"), "--frobnicate");
  fails(run(data("letters/nef.vsh") + " --threads -1"), "--threads");
  fails(run(data("letters/nef.vsh") + " --simplify nan"), "--simplify: expected a number of at least 0, not 'nan'");
  fails(run(data("letters/nef.vsh") + " --at-least 0"), "--at-least: expected a positive number, not '0'");
  fails(run(data("letters") + " --turntable 12"), "give --K f,cx,cy, --radius R and --height H");
  fails(run(data("letters") + " --turntable 0 --K 9,5,5 --radius 4"), "--turntable N: from 2 to 100000");
  fails(run(data("letters/nef.vsh") + " --box 0,0,0,nan,1,1"), "'nan' in '0,0,0,nan,1,1' is not a number");
  fails(run(data("letters/nef.vsh") + " --threshold bright"), "neither a number nor otsu");
  fails(run(data("letters/nef.vsh") + " --channel infrared"), "--channel");
  fails(run(data("letters/nef.vsh") + " --min-area -1"), "--min-area");
  fails(run(data("letters/nef.vsh") + " --pixel-origin middle"), "--pixel-origin");
  fails(run(data("letters/nef.vsh") + " --report " + s.folder().string()), "is a directory");
  fails(run(data("letters/nef.vsh") + " --overlay " + data("letters/nef.vsh")), "cannot make the directory");
  fails(run(data("letters/nef.vsh") + " --silhouette " + (s.folder() / "none.json").string()), "no such file");
  fails(run(data("eight/eight.json") + " --images " + data("letters")),
        "contains 0 images, but the scene has 12 views");
  fails(run(data("eight") + " --turntable 11 --K 400,160,120 --radius 2 --height 1"),
        "eight contains 12 images, but the scene has 11 views; --images DIR names another folder");
  fails(run(data("eight/eight.json") + " -o hull.xyz"), "hull.xyz: unknown extension; use ");
  fails(run(data("eight/eight.json") + " --images /no/such/place"), "is not a directory of images");
  fails(run(data("eight/eight.json") + " --channel red"), "1 channels only");
  fails(run(data("eight/eight.json") + " --min-area 1e6"), "view eight_00.png: the silhouette is empty without");
  fails(run(data("letters/nef.vsh") + " --silhouette " + s.write("eight.json", "[[[0,0],[1,1],[1,0],[0,1]]]").string()),
        "view 1: polygon 1 crosses itself");
  fails(run(data("letters/nef.vsh") + " --silhouette " + s.write("nan.json", "[[[0,0],[1,1],[1,NaN]]]").string()),
        "not valid JSON");
  fails(run(data("letters/nef.vsh") + " --silhouette " + s.write("line.json", "[[[0,0],[1,1],[2,2]]]").string()),
        "has no area");
  fails(run(data("letters/nef.vsh") + " --silhouette " + s.write("none.json", "[]").string()),
        "view 1: the silhouette is empty");
  fails(run(data("letters/nef.vsh") + " -o " + (s.folder() / "x.unknown").string()), "unknown");
  fails(run(data("letters/nef.vsh") + " -o " + (s.folder() / "no/such/folder/x.off").string()), "x.off");
  const std::string one = "a 100 0 0 0 0 100 0 0 0 0 1 10\n";
  fails(run(s.write("p.txt", one).string()), "view a: there is no image");
  cv::imwrite((s.folder() / "a.png").string(), cv::Mat(8, 8, CV_8U, cv::Scalar(0)));
  fails(run((s.folder() / "p.txt").string()), "view a: the silhouette is empty (values of ");
  fails(run((s.folder() / "p.txt").string()), "photographs need --mask auto)");
  cv::imwrite((s.folder() / "a.png").string(), cv::Mat(8, 8, CV_8U, cv::Scalar(255)));
  fails(run((s.folder() / "p.txt").string()), "give a box with --box");
  fails(run((s.folder() / "p.txt").string() + " --silhouette b=x.json"), "no view 'b'");
  CHECK(run((s.folder() / "p.txt").string() + " --box -1,-1,-1,1,1,1").code == 0);
  CHECK(run("--help").code == 0);
}

TEST_CASE("a folder with the name of a subcommand is a scene as ./NAME") {
  const Scratch s;
  std::filesystem::copy(data("eight"), s.folder() / "masks");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(s.folder());
  const Outcome taken = run("masks --turntable 12");
  const Outcome meant = run("./masks --turntable 12");
  std::filesystem::current_path(before);
  CHECK(taken.code == 2);
  CHECK_THAT(taken.output, Contains("'masks' is a subcommand; if you mean the folder of this name, write ./masks"));
  CHECK_THAT(meant.output, Contains("--turntable: the camera is missing"));
}

TEST_CASE("A decimated hull is a legal mesh of few triangles, whose distance is told") {
  const Scratch s;
  const std::string mesh = (s.folder() / "hull.off").string();
  const std::string scene = data("eight/eight.json") + " --simplify 2 --exact -o " + mesh;
  const Outcome outcome = run(scene + " --decimate 200 --json");
  REQUIRE(outcome.code == 0);
  const nlohmann::json decimated = nlohmann::json::parse(outcome.output)["decimated"];
  CHECK(decimated["triangles"] <= 200);
  CHECK(decimated["distance"]["low"] > 0);
  CHECK(decimated["distance"]["high"] >= decimated["distance"]["low"]);
  const nef::Polyhedron small = nef::read_polyhedron(mesh);
  CHECK(nef::counts(small).vertices == decimated["vertices"]);
  REQUIRE(run(scene).code == 0);
  const nef::Polyhedron whole = nef::read_polyhedron(mesh);
  CHECK(nef::counts(whole).vertices > 2 * nef::counts(small).vertices);
  // The sets differ, but by no more than the distance allows: the volume of a shell of that thickness.
  const double difference = nef::nearest_double(*nef::volume(nef::symmetric_difference(whole, small)));
  CHECK(difference > 0);
  CHECK(difference < 2 * decimated["distance"]["high"].get<double>() * nef::surface_area(whole));
  CHECK_THAT(run(scene + " --decimate 200").output, Contains("decimated to"));
  CHECK(run(data("letters/mpi.vsh") + " --decimate 60").code == 2);
  CHECK_THAT(run(data("letters/mpi.vsh") + " --decimate 60 -o a.nef").output, Contains("a.nef cannot store this"));
}

TEST_CASE("The option --json prints the report and nothing else, --quiet nothing at all") {
  const Scratch s;
  const std::string report = (s.folder() / "r.json").string();
  const Outcome outcome =
      run(data("letters/mpi.vsh") + " --json --verify --exact-volume --threads 1 --report " + report);
  REQUIRE(outcome.code == 0);
  const nlohmann::json printed = nlohmann::json::parse(outcome.output);
  CHECK(printed == read_json(report));
  for (const char* key : {"views", "result", "verify", "box", "predicates"}) {
    CHECK(printed.contains(key));
  }
  for (const char* key : {"vertices", "edges", "facets", "volumes", "shells", "bounded", "open", "closed", "regular",
                          "volume", "volume_double", "area", "bbox", "bbox_exact", "euler_numbers"}) {
    CHECK(printed["result"].contains(key));  // the keys of nef info --json
  }
  CHECK(printed["result"]["volume_double"].get<double>() ==
        nef::nearest_double(nef::parse_rational(printed["result"]["volume"].get<std::string>())));
  CHECK(run(data("letters/mpi.vsh") + " --quiet --verify").output.empty());
  CHECK(run(data("letters/mpi.vsh") + " --verify --report -").output.find("\"views\"") != std::string::npos);
  const Outcome version = run("--version");
  CHECK(version.code == 0);
  CHECK_THAT(version.output, Contains("visual_hull " NEF_VERSION));
}

TEST_CASE("The volume is a double with a bound for its error, unless the exact one is asked for") {
  const std::string scene = data("eight/eight.json") + " --simplify 2 --json";
  const nlohmann::json quick = nlohmann::json::parse(run(scene).output)["result"];
  const nlohmann::json exact = nlohmann::json::parse(run(scene + " --exact-volume").output)["result"];
  CHECK(quick["volume"].is_null());
  const double error = quick["volume_error"];
  const double volume = quick["volume_double"];
  CHECK(error < 1e-8 * volume);
  CHECK(abs(nef::parse_rational(exact["volume"].get<std::string>()) - nef::exact_rational(volume)) <=
        nef::exact_rational(error));
}

TEST_CASE("Both ways write the same hull, the direct one is refused where it cannot be gone") {
  const Scratch s;
  const std::string scene = data("elk/elk.json") + " --simplify 1 -q";
  const std::string direct = (s.folder() / "direct.nef").string();
  const std::string cones = (s.folder() / "cones.nef").string();
  CHECK(run(scene + " --way direct -o " + direct).code == 0);
  CHECK(run(scene + " --way cones -o " + cones).code == 0);
  CHECK(nef::equal(nef::read_polyhedron(direct), nef::read_polyhedron(cones)));
  const auto two = s.write("p.txt", "a 10 0 0 0 0 10 0 0 0 0 1 0\nb 10 0 0 0 0 10 0 0 0 0 1 0\n");
  const auto a = s.write("a.json", "[[[0,0],[1,0],[1,1],[0,1]]]");
  const Outcome refused = run(two.string() + " --silhouette " + a.string() + " --silhouette " + a.string() +
                              " --box=-5,-5,1,5,5,2 --way direct");
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains("use --way cones"));
}

TEST_CASE("Views that are left out by name leave the hull of the others") {
  const Scratch s;
  nlohmann::json scene = read_json(data("eight/eight.json"));
  scene["cameras"].erase(5);
  scene["cameras"].erase(1);
  for (auto& camera : scene["cameras"]) camera["image"] = data("eight/" + camera["image"].get<std::string>());
  const std::string others = (s.folder() / "others.nef").string();
  const std::string without = (s.folder() / "without.nef").string();
  const std::string names = " --without eight_05.png eight_01.png";
  CHECK(run(s.write("others.json", scene.dump()).string() + " -q -o " + others).code == 0);
  CHECK(run(data("eight/eight.json") + names + " -q -o " + without).code == 0);
  CHECK(nef::equal(nef::read_polyhedron(without), nef::read_polyhedron(others)));
  const Outcome checked = run(data("eight/eight.json") + names + " --check");
  CHECK_THAT(checked.output, Contains("10 views") && !Contains("eight_05.png"));
  const Outcome nobody = run(data("eight/eight.json") + " --without eight");
  CHECK(nobody.code == 2);
  CHECK_THAT(nobody.output, Contains("view eight cannot be left out"));
  const Outcome frames = run(data("eight/eight.json") + " --without eight_01.png --frames a%d -o b%d.off");
  CHECK(frames.code == 2);
  CHECK_THAT(frames.output, Contains("--without is for one hull"));
}

TEST_CASE("A box that cuts the hull, and views that the frame cuts: both ways write the same hull") {
  const Scratch s;
  const std::filesystem::path folder = s.folder() / "elk";
  std::filesystem::copy(data("elk"), folder);
  for (const char* name : {"elk_02.png", "elk_07.png"}) {
    const cv::Mat mask = cv::imread((folder / name).string(), cv::IMREAD_GRAYSCALE);
    REQUIRE(cv::imwrite((folder / name).string(), mask.colRange(0, mask.cols / 2)));
  }
  const std::string scene = (folder / "elk.json").string() + " --simplify 1 --border unknown --json";
  const std::string cut = " --box=-100,-40,-200,200,50,20";  // the hull is from -51, -81, -102 to 99, 79, 55
  for (const std::string& options : {std::string(), cut}) {
    INFO(options);
    const std::string direct = (s.folder() / "direct.nef").string();
    const std::string cones = (s.folder() / "cones.nef").string();
    REQUIRE(run(scene + options + " --way direct -o " + direct).code == 0);
    REQUIRE(run(scene + options + " --way cones -o " + cones).code == 0);
    CHECK(nef::equal(nef::read_polyhedron(direct), nef::read_polyhedron(cones)));
  }
}

TEST_CASE("A check says what is understood and computes nothing") {
  const Outcome check = run(data("elk/elk.json") + " --check");
  CHECK(check.code == 0);
  CHECK_THAT(check.output, Contains("12 views from a JSON scene"));
  CHECK_THAT(check.output, Contains("focal length 400 pixels"));
  CHECK_THAT(check.output, Contains("elk_11.png"));
  const Scratch s;
  const auto lost = s.write("p.txt", "a 10 0 0 0 0 10 0 0 0 0 1 0\n");
  const Outcome missing = run(lost.string() + " --check");
  CHECK(missing.code == 2);
  CHECK_THAT(missing.output, Contains("there is no image"));
}

TEST_CASE("A check shows the masks: how they are made, how much is object, and pictures") {
  const Scratch s;
  const std::filesystem::path folder = s.folder() / "elk";
  std::filesystem::copy(data("elk"), folder);
  const std::string cut = (folder / "elk_07.png").string();
  const cv::Mat whole = cv::imread(cut, cv::IMREAD_GRAYSCALE);
  REQUIRE(cv::imwrite(cut, whole.colRange(0, whole.cols / 2)));
  const std::string scene = (folder / "elk.json").string() + " --check";
  const std::filesystem::path pictures = s.folder() / "pictures";
  const Outcome shown = run(scene + " --mask auto --overlay " + pictures.string());
  INFO(shown.output);
  CHECK(shown.code == 0);
  CHECK_THAT(shown.output, Contains("masks: "));
  const cv::Mat mask = cv::imread((folder / "elk_03.png").string(), cv::IMREAD_GRAYSCALE);
  const double share = 100.0 * cv::countNonZero(mask > 127) / static_cast<double>(mask.total());
  CHECK_THAT(shown.output, Contains(fmt::format("elk_03.png: the object is {:.1f} % of the image", share)));
  const auto line_of = [&](const std::string& name) {
    const std::size_t at = shown.output.find(name + ": the object");
    return shown.output.substr(at, shown.output.find('\n', at) - at);
  };
  CHECK_THAT(line_of("elk_07.png"), Contains("cut by the frame"));
  CHECK_THAT(line_of("elk_03.png"), !Contains("cut by the frame"));
  std::size_t drawn = 0;
  for (const auto& entry : std::filesystem::directory_iterator(pictures)) {
    const cv::Mat picture = cv::imread(entry.path().string());
    cv::Mat red;
    cv::inRange(picture, cv::Scalar(0, 0, 200), cv::Scalar(120, 120, 255), red);
    CHECK(cv::countNonZero(red) > 50);  // the outline
    ++drawn;
  }
  CHECK(drawn == 12);
  // With --border unknown what is left counts all the same.
  CHECK_THAT(run(scene + " --border unknown --mask auto").output, Contains(line_of("elk_07.png")));
  CHECK_THAT(run(scene).output, !Contains("of the image"));
}

TEST_CASE("Suspects are listed in the report, none on a clean set") {
  const nlohmann::json report =
      nlohmann::json::parse(run(data("elk/elk.json") + " --simplify 1 --suspects --json -q").output);
  CHECK(report["suspects"].empty());
  for (const auto& view : report["views"]) {
    for (const char* key : {"residual", "fall", "removed", "relative", "score"}) CHECK(view.contains(key));
  }
}

TEST_CASE("A frame that cuts silhouettes is told, with the remedy") {
  Result result;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    result.views.emplace_back();
    result.views.back().name = name;
  }
  CHECK_FALSE(cut_note(result));
  result.views[1].silhouette.cut_by_frame = true;
  CHECK_THAT(cut_note(result).value(), StartsWith("the image frame cuts the silhouette of view b;"));
  for (ViewResult& view : result.views) view.silhouette.cut_by_frame = true;
  CHECK_THAT(cut_note(result).value(),
             Contains("silhouettes of views a, b, c and 2 more") && Contains("--border unknown"));
  for (ViewResult& view : result.views) view.silhouette.background = true;  // as --border unknown has it
  CHECK_FALSE(cut_note(result));
}

TEST_CASE("Help names every option") {
  const std::string help = run("--help").output;
  for (const char* option :
       {"--images",   "--silhouette",    "--threshold", "--channel",      "--invert",   "--pixel-origin", "--border",
        "--min-area", "--simplify",      "--outer",     "--box",          "--output",   "--exact",        "--binary",
        "--verify",   "--report",        "--overlay",   "--page",         "--threads",  "--json",         "--quiet",
        "--version",  "Exit codes",      "--check",     "--up",           "--matrices", "--turntable",    "--way",
        "--suspects", "--drop-suspects", "--at-least",  "--exact-volume", "--refine",   "--refined-scene"}) {
    CHECK_THAT(help, Contains(option));
  }
}

TEST_CASE("What a format does not hold is told, unless nobody listens") {
  // One camera's two views agree in a square and touch along u = 3: a solid, and a facet that no mesh file holds.
  const Scratch s;
  const auto scene = s.write("p.txt", "a 10 0 0 0 0 10 0 0 0 0 1 0\nb 10 0 0 0 0 10 0 0 0 0 1 0\n");
  const auto a = s.write("a.json", "[[[0,0],[1,0],[1,1],[0,1]], [[2,0],[3,0],[3,1],[2,1]]]");
  const auto b = s.write("b.json", "[[[0,0],[1,0],[1,1],[0,1]], [[3,0],[4,0],[4,1],[3,1]]]");
  const std::string arguments = scene.string() + " --silhouette " + a.string() + " --silhouette " + b.string() +
                                " --box=-5,-5,1,5,5,2 -o " + (s.folder() / "x.off").string();
  const Outcome loud = run(arguments);
  CHECK(loud.code == 0);
  CHECK_THAT(loud.output, Contains("visual_hull: note: "));
  const Outcome json = run(arguments + " --json -q");
  CHECK(nlohmann::json::parse(json.output)["messages"].size() >= 1);
  CHECK_THAT(run(arguments + " --json").output, Contains("visual_hull: note: "));
  CHECK(run(arguments + " -q").output.empty());
  const Outcome exact = run(scene.string() + " --silhouette " + a.string() + " --silhouette " + b.string() +
                            " --box=-5,-5,1,5,5,2 -o " + (s.folder() / "x.nef").string());
  CHECK(exact.output.find("note") == std::string::npos);
}

TEST_CASE("A page from the command line") {
  const Scratch s;
  const Outcome page = run(data("letters/mpi.vsh") + " --page " + (s.folder() / "x.htm").string());
  CHECK(page.code == 2);
  CHECK_THAT(page.output, Contains("the extension must be .html"));
}

TEST_CASE("An empty hull is exit code 1 and names the view") {
  const Scratch s;
  const auto scene = s.write("p.txt", "a 10 0 0 0 0 10 0 0 0 0 1 10\nb 10 0 0 0 0 10 0 0 0 0 1 10\n");
  const auto left = s.write("left.json", "[[[0,0],[1,0],[1,1],[0,1]]]");
  const auto right = s.write("right.json", "{\"polygons\": [[[2,0],[\"7/2\",0],[3,1.5]]]}");
  const Outcome outcome = run(scene.string() + " --silhouette " + left.string() + " --silhouette b=" + right.string() +
                              " --box=-5,-5,-5,5,5,5");
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.output, Contains("the hull is empty: views a and b have no point in common"));
}

}  // namespace
}  // namespace nef::visual_hull
