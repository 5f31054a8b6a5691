// SPDX-License-Identifier: Apache-2.0
//
// Files are written whole or not at all, links and pipes are what they are, and messages quote little.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <utility>
#include <vector>

#include "nef/base/text/in_quotes.h"
#include "nef/construct/construct.h"
#include "nef/io/content_hash.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Standard input is something else for a while.
class PipedInput {
 public:
  explicit PipedInput(int descriptor) : own_(fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10)) {
    dup2(descriptor, STDIN_FILENO);
    close(descriptor);
  }
  explicit PipedInput(const std::string& bytes) : PipedInput(pipe_with(bytes)) {}
  ~PipedInput() {
    dup2(own_, STDIN_FILENO);
    close(own_);
  }
  PipedInput(const PipedInput&) = delete;
  PipedInput& operator=(const PipedInput&) = delete;

 private:
  // The bytes, which are few enough for a pipe to hold.
  static int pipe_with(const std::string& bytes) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0 || write(ends[1], bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("no pipe");
    }
    close(ends[1]);
    return ends[0];
  }

  int own_;
};

}  // namespace

TEST_CASE("Writing replaces the file alone, with its permissions, or with those of any new file", "[file]") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.off");
  for (const char* text : {"one", "two"}) {
    write_file(path, text);
    CHECK(slurp(path) == text);
    CHECK(folder.file_count() == 1);
  }
  const mode_t mask = umask(0);
  umask(mask);
  struct stat about {};
  REQUIRE(stat(path.c_str(), &about) == 0);
  CHECK((about.st_mode & 0777U) == (0666U & ~mask));
  for (const mode_t mode : {0600U, 0640U, 0666U, 0755U}) {
    REQUIRE(chmod(path.c_str(), mode) == 0);
    write_file(path, "three");
    REQUIRE(stat(path.c_str(), &about) == 0);
    CHECK((about.st_mode & 07777U) == mode);
  }
  CHECK(refusal([&] { write_file(folder.file("none/a.off"), "x"); }).find("does its folder exist?") !=
        std::string::npos);
}

TEST_CASE("A symbolic link stays and what it points to is written", "[file]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "data");
  fs::create_symlink("data/real.off", folder.path() / "one.off");
  fs::create_symlink("one.off", folder.path() / "two.off");
  for (const char* text : {"new", "replaced"}) {  // the target need not exist
    write_file(folder.file("two.off"), text);
    CHECK(fs::is_symlink(folder.path() / "two.off"));
    CHECK(fs::is_symlink(folder.path() / "one.off"));
    CHECK(slurp(folder.file("data/real.off")) == text);
    CHECK(folder.file_count() == 3);
  }
}

TEST_CASE("What a killed run left behind is removed, what a living one writes is not", "[file]") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.off");
  const std::string partial = folder.write(".a.off.partial", "half");
  write_file(path, "whole");
  CHECK(slurp(path) == "whole");
  CHECK_FALSE(fs::exists(partial));
  folder.write(".a.off.partial", "of another");
  const int other = open(partial.c_str(), O_WRONLY);
  REQUIRE(flock(other, LOCK_EX | LOCK_NB) == 0);
  write_file(path, "again");
  CHECK(slurp(path) == "again");
  CHECK(slurp(partial) == "of another");
  close(other);
}

TEST_CASE("Meshes are read from standard input, whatever their format", "[file]") {
  const TemporaryFolder folder;
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, 3});
  for (const char* name : {"a.off", "a.obj", "a.stl", "a.ply", "a.nef", "a.nef3", "a.glb", "a.3mf"}) {
    for (const bool binary : {false, true}) {
      const std::string extension = std::string(name).substr(2);
      if (binary && extension != "stl" && extension != "ply") continue;
      PolyhedronWriteOptions options;
      options.binary = binary;
      write_polyhedron(folder.file(name), box, options);
      for (const char* input : {"-", "/dev/stdin", "/proc/self/fd/0"}) {
        INFO(name << " from " << input);
        const PipedInput piped(slurp(folder.file(name)));
        CHECK(equal(read_polyhedron(input), box));
      }
    }
  }
}

TEST_CASE("Devices and named pipes, which may never end, are refused before they are opened", "[file]") {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe.off");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  fs::create_symlink("pipe.off", folder.path() / "link.nef");
  for (const std::string& path : {pipe, folder.file("link.nef"), std::string("/dev/zero")}) {
    INFO(path);
    const std::string words = path + ": is a device or a pipe";
    CHECK_THAT(refusal([&] { read_polyhedron(path); }), Catch::StartsWith(words));
    CHECK_THAT(refusal([&] { content_hash_of_file(path); }), Catch::StartsWith(words));
    CHECK_THAT(refusal([&] { require_readable_file(path); }), Catch::StartsWith(words));
  }
  {
    const PipedInput zeros(open("/dev/zero", O_RDONLY));
    CHECK_THAT(refusal([] { read_file("-"); }), Catch::StartsWith("-: is a device"));
  }
  // Nobody has this much memory, and the file takes none.
  const std::string sparse = folder.write("sparse.off", "OFF");
  fs::resize_file(sparse, std::uintmax_t{1} << 42U);
  CHECK_THAT(refusal([&] { read_file(sparse); }), Catch::Contains("larger than a quarter of the memory"));
}

TEST_CASE("Hashes tell files and folders by what they hold", "[file]") {
  const TemporaryFolder folder;
  const std::string one = folder.write("one", "content");
  CHECK(content_hash("content") == content_hash_of_file(one));
  CHECK(content_hash("content") != content_hash("content "));
  CHECK(content_hash("").size() == 32);
  const auto hash = [&folder] { return content_hash_of_file(folder.path().string()); };
  std::set<std::string> seen{hash()};
  fs::create_directory(folder.path() / "below");
  const std::vector<std::pair<std::string, std::string>> files{
      {"two", "a"}, {"two", "b"}, {"three", "b"}, {"below/one", "b"}};
  for (const auto& [name, text] : files) {
    folder.write(name, text);
    CHECK(seen.insert(hash()).second);
  }
  fs::rename(folder.file("three"), folder.file("four"));
  CHECK(seen.insert(hash()).second);
  fs::rename(folder.file("four"), folder.file("three"));
  CHECK_FALSE(seen.insert(hash()).second);
}

TEST_CASE("Coordinates that a format can not hold are refused before anything is written", "[file]") {
  const TemporaryFolder folder;
  const Polyhedron huge = make_box({0, 0, 0}, {1, 1, parse_rational("1e400")});
  for (const char* name : {"a.off", "a.obj", "a.stl", "a.ply"}) {
    const std::string why = refusal([&] { write_polyhedron(folder.file(name), huge); });
    CHECK(why.find("--exact") != std::string::npos);
    CHECK(folder.file_count() == 0);
  }
  const Polyhedron large = make_box({0, 0, 0}, {1, 1, parse_rational("1e40")});
  PolyhedronWriteOptions binary;
  binary.binary = true;
  CHECK(refusal([&] { write_polyhedron(folder.file("a.stl"), large, binary); }).find("single precision") !=
        std::string::npos);
  CHECK(folder.file_count() == 0);
  PolyhedronWriteOptions exact;
  exact.exact = true;
  write_polyhedron(folder.file("a.off"), huge, exact);
  CHECK(equal(read_polyhedron(folder.file("a.off")), huge));
}

TEST_CASE("Bytes of unknown origin become text", "[file]") {
  CHECK(utf8("caf\xc3\xa9") == "caf\xc3\xa9");
  CHECK(utf8("caf\xe9.off") == "caf\xef\xbf\xbd.off");
  CHECK(utf8("\xf0\x9f\x98\x80") == "\xf0\x9f\x98\x80");
  CHECK(utf8("\xed\xa0\x80").find("\xed\xa0\x80") == std::string::npos);  // a surrogate
  CHECK(utf8("\xc0\x80").find('\xc0') == std::string::npos);              // an overlong form
  CHECK(in_quotes("word") == "'word'");
  CHECK(in_quotes(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
  CHECK(in_quotes("a\x1b\xe9z") == "'a\\x1b\\xe9z'");
}

TEST_CASE("A file that is not what its name says is not quoted", "[file]") {
  const TemporaryFolder folder;
  const std::string secret = "root:x:0:0:root:/root:/bin/bash\nsecond:line\n" + std::string(100, 's') + "\n";
  for (const char* name : {"a.off", "a.obj", "a.stl", "a.ply", "a.nef", "a.nef3", "a", "a.txt"}) {
    const std::string path = folder.write(name, secret);
    const std::string why = refusal([&] { read_polyhedron(path); });
    INFO(why);
    CHECK(!why.empty());
    CHECK(why.find("root") == std::string::npos);
    CHECK(why.find("second") == std::string::npos);
    CHECK(why.find("sss") == std::string::npos);
  }
}

}  // namespace nef::test
