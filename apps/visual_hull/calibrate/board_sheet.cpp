// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/calibrate/board_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "apps/view/image.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

constexpr double kPageMargin = 12;    // millimetres, around the board
constexpr double kLineBelow = 6;      // from the board to the line that is to be measured
constexpr double kLineWidth = 0.3;    // of that line
constexpr double kTextSize = 3;       // height of letters
constexpr double kPoint = 72 / 25.4;  // PDF's units a millimetre

// A line to measure: 100 mm, or less below a small board.
double measured_length(const Board& board) { return std::min(100.0, 10 * std::floor(board.width() / 10)); }

std::string board_caption(const Board& board) {
  return fmt::format("{}; print at 100 %: the line is {} mm long", board.text(), measured_length(board));
}

/// All that is on a page.
struct Sheet {
  PageSize page;
  std::vector<BlackTile> black;      // the board and the line below it, from the upper left corner of the page
  double text_left = 0, text_y = 0;  // where the caption begins, on its base line
};

Sheet sheet_of(const Board& board) {
  Sheet sheet{page_for(board), black_tiles(board)};
  const double left = (sheet.page.width - board.width()) / 2;
  const double top = (sheet.page.height - board.height()) / 2;
  for (BlackTile& tile : sheet.black) {
    tile.x += left;
    tile.y += top;
  }
  const double below = top + board.height() + kLineBelow;
  const double length = measured_length(board);
  sheet.black.push_back({left, below, length, kLineWidth});
  for (const double end : {0.0, length - kLineWidth}) {
    sheet.black.push_back({left + end, below - 1, kLineWidth, 2 + kLineWidth});
  }
  sheet.text_left = left;
  sheet.text_y = below + 1.5 + kTextSize;
  return sheet;
}

std::string pdf_content(const Board& board, const Sheet& sheet) {
  const auto up = [&sheet](double y) { return (sheet.page.height - y) * kPoint; };
  std::string text;
  for (const BlackTile& tile : sheet.black) {
    text += fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} re\n", tile.x * kPoint, up(tile.y + tile.height),
                        tile.width * kPoint, tile.height * kPoint);
  }
  text += "f\n";  // one path: no seams between tiles
  text += fmt::format("BT /F {:.2f} Tf {:.2f} {:.2f} Td ({}) Tj ET\n", kTextSize * kPoint, sheet.text_left * kPoint,
                      up(sheet.text_y), board_caption(board));
  return text;
}

std::string board_pdf(const Board& board) {
  const Sheet sheet = sheet_of(board);
  const std::string content = pdf_content(board, sheet);
  const std::array<std::string, 5> objects{
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.4f} {:.4f}] /Contents 4 0 R "
                  "/Resources << /Font << /F 5 0 R >> >> >>",
                  sheet.page.width * kPoint, sheet.page.height * kPoint),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content),
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
  std::string file = "%PDF-1.4\n";
  std::string table = fmt::format("xref\n0 {}\n0000000000 65535 f \n", objects.size() + 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    table += fmt::format("{:010} 00000 n \n", file.size());
    file += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
  }
  const std::size_t begin = file.size();
  return file + table +
         fmt::format("trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n", objects.size() + 1, begin);
}

std::string board_svg(const Board& board) {
  const Sheet sheet = sheet_of(board);
  std::string path;
  for (const BlackTile& tile : sheet.black) {
    path += fmt::format("M{:.5g} {:.5g}h{:.5g}v{:.5g}h{:.5g}z\n", tile.x, tile.y, tile.width, tile.height, -tile.width);
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<path d=\"{2}\"/>\n"
      "<text x=\"{3}\" y=\"{4}\" font-family=\"sans-serif\" font-size=\"{5}\">{6}</text>\n</svg>\n",
      sheet.page.width, sheet.page.height, path, sheet.text_left, sheet.text_y, kTextSize, board_caption(board));
}

std::string board_png(const Board& board) {
  constexpr double kPixels = 20;  // a millimetre
  constexpr double kLongest = 2000;
  if (std::max(board.width(), board.height()) > kLongest) {
    throw nef::InputError("a board of more than 2 m cannot be a PNG; name a .pdf or .svg file");
  }
  const cv::Mat picture = board_picture(board, kPixels);
  return nef::view::png_bytes({static_cast<std::uint32_t>(picture.cols),
                               static_cast<std::uint32_t>(picture.rows),
                               {picture.datastart, picture.dataend},
                               static_cast<std::uint32_t>(1000 * kPixels)});
}

}  // namespace

PageSize page_for(const Board& board) {
  constexpr std::array<PageSize, 3> kPages{{{297, 210}, {420, 297}, {594, 420}}};
  const double width = board.width() + 2 * kPageMargin;
  const double height = board.height() + 2 * kPageMargin;
  for (const PageSize& page : kPages) {
    if (width <= page.width && height <= page.height) return page;
    if (width <= page.height && height <= page.width) return {page.height, page.width};
  }
  return {width, height};
}

cv::Mat board_picture(const Board& board, double pixels) {
  const double border = board.square;
  // Of the pixels, those whose centres are within.
  const auto first = [&](double mm) { return static_cast<int>(std::ceil((mm + border) * pixels - 0.5)); };
  cv::Mat picture(first(board.height() + border), first(board.width() + border), CV_8UC3, cv::Scalar::all(255));
  for (const BlackTile& tile : black_tiles(board)) {
    const cv::Point corner(first(tile.x), first(tile.y));
    const cv::Point end(first(tile.x + tile.width), first(tile.y + tile.height));
    picture(cv::Rect(corner, end)).setTo(cv::Scalar::all(0));
  }
  return picture;
}

std::string board_file(const Board& board, const std::string& extension) {
  if (extension == ".pdf") return board_pdf(board);
  if (extension == ".svg") return board_svg(board);
  if (extension == ".png") return board_png(board);
  throw nef::InputError("a board is written as .pdf, .svg or .png");
}

}  // namespace nef::visual_hull
