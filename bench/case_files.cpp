// SPDX-License-Identifier: Apache-2.0
//
// Cases as OFF files: integers and p/q, so that nothing is rounded on the way to either library.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bench/generators.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::bench {
namespace {

void write_off(const Mesh& mesh, const std::string& path) {
  std::ostringstream out;
  out << "OFF\n" << mesh.vertices.size() << ' ' << mesh.face_count() << " 0\n";
  for (const Rational3& v : mesh.vertices)
    out << to_string(v[0]) << ' ' << to_string(v[1]) << ' ' << to_string(v[2]) << '\n';
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    out << mesh.face(f).size();
    for (const std::uint32_t corner : mesh.face(f)) out << ' ' << corner;
    out << '\n';
  }
  write_file(path, out.str());
}

Mesh read_off(const std::string& path) {
  std::ifstream in(path);
  std::string word;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  if (!(in >> word >> vertices >> faces >> edges) || word != "OFF") throw InputError(path + ": not an OFF file");
  Mesh mesh;
  mesh.vertices.resize(vertices);
  for (Rational3& v : mesh.vertices) {
    for (Rational& x : v) {
      in >> word;
      x = parse_rational(word);
    }
  }
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t count = 0;
    in >> count;
    face.resize(count);
    for (std::uint32_t& corner : face) in >> corner;
    mesh.push_face(face);
  }
  if (!in) throw InputError(path + ": ends too early");
  return mesh;
}

CaseKind read_kind(std::istream& in, const std::string& directory) {
  CaseKind kind;
  int operation = 0;
  if (!(in >> kind.name >> operation) || operation < 0 || operation > 4) {
    throw InputError(directory + "/case.txt: not a case; write one with nef_bench_generate");
  }
  kind.operation = static_cast<Operation>(operation);
  return kind;
}

}  // namespace

void write_case(const Case& bench_case, const std::string& directory) {
  std::filesystem::create_directories(directory);
  std::ostringstream out;
  out << bench_case.name << '\n' << static_cast<int>(bench_case.operation) << '\n';
  for (std::size_t i = 0; i < bench_case.operands.size(); ++i) {
    out << (bench_case.operands[i].surface ? "surface\n" : "solid\n");
    write_off(bench_case.operands[i].mesh, directory + "/" + std::to_string(i) + ".off");
  }
  write_file(directory + "/case.txt", out.str());
}

CaseKind read_case_kind(const std::string& directory) {
  std::ifstream in(directory + "/case.txt");
  return read_kind(in, directory);
}

void read_operands(const std::string& directory, const std::function<void(const Operand&)>& take) {
  std::ifstream in(directory + "/case.txt");
  static_cast<void>(read_kind(in, directory));
  std::size_t index = 0;
  for (std::string kind; in >> kind; ++index) {
    take({read_off(directory + "/" + std::to_string(index) + ".off"), kind == "surface"});
  }
}

}  // namespace nef::bench
