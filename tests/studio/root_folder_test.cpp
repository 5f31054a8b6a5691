// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/root/root_folder.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "nef/base/error.h"
#include "tests/support/temporary_folder.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

// root/a.off, root/sub/b.off, secret.txt beside the root, and links to both.
class Tree : public nef::test::TemporaryFolder {
 public:
  Tree() {
    fs::create_directories(root() / "sub");
    std::ofstream(root() / "a.off") << "a";
    std::ofstream(root() / "sub" / "b.off") << "bb";
    std::ofstream(root() / ".hidden") << "h";
    std::ofstream(fs::path(path()) / "secret.txt") << "secret";
    fs::create_symlink("a.off", root() / "inner.off");
    fs::create_symlink("../secret.txt", root() / "outer.txt");
    fs::create_directory_symlink("..", root() / "up");
  }
  [[nodiscard]] fs::path root() const { return fs::path(path()) / "root"; }
};

TEST_CASE("Files below the root are found, by their names from it or from a folder of it") {
  const Tree tree;
  const RootFolder root(tree.root());
  CHECK(root.read("a.off", 10) == "a");
  CHECK(root.read("sub/../a.off", 10) == "a");
  CHECK(root.read("inner.off", 10) == "a");
  CHECK(root.file("b.off", "sub").filename() == "b.off");
  CHECK(root.file("../a.off", "sub").filename() == "a.off");
  CHECK(root.mesh("a.off#part") == (fs::canonical(tree.root()) / "a.off#part").string());
  std::vector<std::string> names;
  for (const RootFile& file : root.list(10)) names.push_back(file.name);
  CHECK(names == std::vector<std::string>{"a.off", "sub/b.off"});
  CHECK(root.list(1).size() == 1);
}

TEST_CASE("Names that lead out of the root are refused, for reading and for writing") {
  const Tree tree;
  const RootFolder root(tree.root());
  const std::string secret = (fs::path(tree.path()) / "secret.txt").string();
  const std::string null("a.off\0.txt", 10);
  for (const std::string& name :
       {std::string("../secret.txt"), std::string("sub/../../secret.txt"), secret, std::string("outer.txt"),
        std::string("up/secret.txt"), std::string("/etc/passwd"), std::string(""), null, std::string("missing.off"),
        std::string("sub"), std::string(2000, 'a')}) {
    CHECK_THROWS_AS(root.file(name), InputError);
    CHECK_THROWS_AS(root.mesh(name), InputError);
    CHECK_THROWS_AS(root.read(name, 100), InputError);
  }
  CHECK_THROWS_AS(root.file("secret.txt", ".."), InputError);
  CHECK_THROWS_AS(root.file("passwd", "/etc"), InputError);
  for (const std::string name :
       {"../new.txt", "up/new.txt", "outer.txt", "/tmp/new.txt", ".bashrc", "none/new.txt", "sub"}) {
    CHECK_THROWS_AS(root.write(name, "x"), InputError);
  }
  CHECK(!fs::exists(fs::path(tree.path()) / "new.txt"));
  CHECK_THROWS_AS(root.read("sub/b.off", 1), InputError);
  CHECK_THROWS_AS(RootFolder(tree.root() / "none"), InputError);
}

TEST_CASE("What is written is there whole") {
  const Tree tree;
  const RootFolder root(tree.root());
  root.write("sub/new.txt", "one");
  CHECK(root.read("sub/new.txt", 10) == "one");
  root.write("sub/new.txt", "");
  CHECK(root.read("sub/new.txt", 10).empty());
  root.write("inner.off", "through a link that stays below");
  CHECK(root.read("a.off", 100) == "through a link that stays below");
  CHECK(fs::is_symlink(tree.root() / "inner.off"));
}

}  // namespace
}  // namespace nef::studio
