// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/pages/page_table.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "apps/studio/pages/computation.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"

namespace nef::studio {
namespace {

Sets box() { return {{"result", make_box({0, 0, 0}, {1, 1, 1})}}; }

// Computes until it is stopped.
std::optional<Sets> forever(const Monitor& monitor) {
  monitor.tell_progress("waiting", 1, 2);
  for (;;) {
    monitor.check_interruption();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// Waits until a page computes.
void wait_for(const PageTable& pages, const std::string& page) {
  while (!pages.progress(page)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST_CASE("The sets of a page's last computation stay, also if the next one fails") {
  PageTable pages(1, {});
  CHECK_THROWS_AS(pages.set("a", "result"), InputError);
  pages.compute("a", [](const Monitor&) { return box(); });
  CHECK(equal(pages.set("a", "result").whole(), make_box({0, 0, 0}, {1, 1, 1})));
  CHECK_THROWS_AS(pages.set("b", "result"), InputError);
  CHECK_THROWS_AS(pages.compute("a", [](const Monitor&) -> std::optional<Sets> { throw InputError("no"); }),
                  InputError);
  pages.compute("a", [](const Monitor&) { return std::nullopt; });
  CHECK(equal(pages.set("a", "result").whole(), make_box({0, 0, 0}, {1, 1, 1})));
  pages.compute("a", [](const Monitor&) { return Sets{{"tiled", TiledPolyhedron(make_box({0, 0, 0}, {1, 1, 1}))}}; });
  CHECK(equal(pages.set("a", "tiled").whole(), make_box({0, 0, 0}, {1, 1, 1})));
  pages.compute("a", [](const Monitor&) { return Sets{{"other", Polyhedron()}}; });
  CHECK_THROWS_AS(pages.set("a", "result"), InputError);
}

TEST_CASE("What the layers of the last scene were drawn from is kept, and of no other scene") {
  PageTable pages(1, {});
  pages.keep_drawn("a", 7, {make_box({0, 0, 0}, {1, 1, 1}), Polyhedron()});
  CHECK(pages.drawn("a", 7, 0).complex().vertex_count() == 8);
  CHECK_THROWS_AS(pages.drawn("a", 7, 2), InputError);
  CHECK_THROWS_AS(pages.drawn("a", 6, 0), InputError);
  CHECK_THROWS_AS(pages.drawn("b", 7, 0), InputError);
  pages.keep_drawn("a", 8, {Polyhedron()});
  CHECK_THROWS_AS(pages.drawn("a", 7, 0), InputError);
}

TEST_CASE("A computation tells how far it is, and is cancelled") {
  PageTable pages(1, {});
  bool cancelled = false;
  std::thread computing([&] {
    try {
      pages.compute("a", forever);
    } catch (const Cancelled&) {
      cancelled = true;
    }
  });
  while (!pages.progress("a") || pages.progress("a")->phase != "waiting") std::this_thread::yield();
  CHECK(pages.progress("a")->total == 2);
  CHECK(!pages.progress("b"));
  pages.cancel("b");
  CHECK(pages.progress("a"));
  pages.cancel("a");
  computing.join();
  CHECK(cancelled);
  CHECK(!pages.progress("a"));
}

TEST_CASE("A newer computation of a page takes the place of the older ones while other pages go on") {
  PageTable pages(1, {});
  std::atomic<int> cancelled{0};
  const auto endless = [&](const std::string& page) {
    try {
      pages.compute(page, forever);
    } catch (const Cancelled&) {
      ++cancelled;
    }
  };
  std::thread other(endless, "b");
  wait_for(pages, "b");
  std::thread first(endless, "a");
  wait_for(pages, "a");
  pages.compute("a", [](const Monitor&) { return box(); });
  first.join();
  CHECK(cancelled == 1);
  CHECK(pages.progress("b"));
  CHECK(equal(pages.set("a", "result").whole(), make_box({0, 0, 0}, {1, 1, 1})));
  pages.close();
  other.join();
  CHECK(cancelled == 2);
  CHECK_THROWS_AS(pages.compute("a", [](const Monitor&) { return box(); }), Cancelled);
}

TEST_CASE("So many pages compute at once, and so many are remembered") {
  PageTable pages(1, {});
  std::vector<std::thread> computing;
  for (std::size_t i = 0; i < PageTable::kMostComputations; ++i) {
    const std::string page(1, static_cast<char>('a' + i));
    computing.emplace_back([&pages, page] { CHECK_THROWS_AS(pages.compute(page, forever), Cancelled); });
    wait_for(pages, page);
  }
  CHECK_THROWS_WITH(pages.compute("z", [](const Monitor&) { return box(); }), Catch::Contains("other pages compute"));
  for (std::size_t i = 0; i < PageTable::kMostComputations; ++i)
    pages.cancel(std::string(1, static_cast<char>('a' + i)));
  for (std::thread& thread : computing) thread.join();
  for (std::size_t i = 0; i <= PageTable::kMostPages; ++i) {
    pages.compute("page" + std::to_string(i), [](const Monitor&) { return box(); });
  }
  CHECK_THROWS_AS(pages.set("page0", "result"), InputError);
  CHECK_NOTHROW(pages.set("page" + std::to_string(PageTable::kMostPages), "result"));
}

TEST_CASE("Computations end at their limits of time and memory, and say so") {
  Computation slow({.seconds = 0.05});
  CHECK_THROWS_WITH(slow.run(1, [](const Monitor& monitor) { static_cast<void>(forever(monitor)); }),
                    Catch::Contains("--time"));
  CHECK(resident_bytes() > 1000000);
  Computation large({.bytes = resident_bytes() / 2});
  CHECK_THROWS_WITH(large.run(1, [](const Monitor& monitor) { static_cast<void>(forever(monitor)); }),
                    Catch::Contains("--memory"));
}

}  // namespace
}  // namespace nef::studio
