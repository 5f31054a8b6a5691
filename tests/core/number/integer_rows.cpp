// SPDX-License-Identifier: Apache-2.0
#include "nef/number/integer_rows.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

namespace nef::test {
namespace {

using IntegerRow = std::vector<Integer>;

// Now and then a giant, of more limbs than a byte counts, and now and then 1.
Integer short_or_giant(std::mt19937& random, int giants_of_100) {
  if (random() % 8 == 0) return 1;
  const bool giant = static_cast<int>(random() % 100) < giants_of_100;
  Integer value = 0;
  for (unsigned limbs = giant ? 120 + random() % 20 : random() % 4; limbs > 0; --limbs) {
    value = (value << 64) + Integer(static_cast<unsigned long>(random()) << 32U | random());
  }
  return random() % 2 == 0 ? value : Integer(-value);
}

IntegerRow random_integer_row(std::mt19937& random, std::size_t width, int giants_of_100) {
  IntegerRow row;
  for (std::size_t i = 0; i < width; ++i) row.push_back(short_or_giant(random, giants_of_100));
  return row;
}

void push_row(IntegerRows& table, const IntegerRow& row) {
  std::vector<mpz_srcptr> views;
  for (const Integer& value : row) views.push_back(value.get_mpz_t());
  table.push(views);
}

bool holds_rows(const IntegerRows& table, const std::vector<IntegerRow>& rows) {
  if (table.size() != rows.size()) return false;
  for (std::uint32_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      if (mpz_cmp(table.at(r, i), rows[r][i].get_mpz_t()) != 0 || table.sign(r, i) != sgn(rows[r][i]) ||
          table.is_one(r, i) != (rows[r][i] == 1)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

TEST_CASE("tables of integers give back what was pushed, short or long, and copies of it") {
  std::mt19937 random(3);
  for (const std::size_t width : {1U, 4U, 5U, 7U, 8U, 9U, 12U}) {
    for (const int giants : {0, 1, 50}) {
      CAPTURE(width, giants);
      IntegerRows table(width);
      IntegerRows copy(width);
      IntegerRows appended(width);
      std::vector<IntegerRow> rows;
      for (int r = 0; r < 60; ++r) {
        rows.push_back(random_integer_row(random, width, giants));
        push_row(table, rows.back());
        copy.push_from(table, static_cast<std::uint32_t>(r));
      }
      for (std::size_t first = 0, count = 1; first < rows.size(); first += count, count = count % 7 + 1) {
        count = std::min(count, rows.size() - first);
        appended.append(table, first, count);
      }
      CHECK(holds_rows(table, rows));
      CHECK(holds_rows(copy, rows));
      CHECK(holds_rows(appended, rows));
      IntegerRows after_giant(width);
      push_row(after_giant, IntegerRow(width, Integer(1) << 64 * 130));
      after_giant.append(table, 0, rows.size());
      for (std::uint32_t r = 0; r < rows.size(); ++r) {
        CHECK(table.equal(r, appended, r));
        CHECK(table.hash(r) == appended.hash(r));
        CHECK(table.hash(r) == after_giant.hash(r + 1));
      }
      while (!rows.empty()) {
        table.pop();
        rows.pop_back();
      }
      rows.push_back(random_integer_row(random, width, 0));
      push_row(table, rows.back());
      CHECK(holds_rows(table, rows));
    }
  }
}

TEST_CASE("tables of integers keep some of their rows, and grow after that") {
  std::mt19937 random(5);
  for (const std::size_t width : {1U, 5U, 7U, 12U}) {
    for (const int giants : {0, 20}) {
      for (const unsigned one_of : {1U, 2U, 5U, 1000U}) {
        CAPTURE(width, giants, one_of);
        IntegerRows table(width);
        std::vector<IntegerRow> rows;
        std::vector<std::uint8_t> used;
        for (int r = 0; r < 61; ++r) {
          IntegerRow row = random_integer_row(random, width, giants);
          push_row(table, row);
          used.push_back(random() % one_of == 0 ? 1 : 0);
          if (used.back() != 0) rows.push_back(std::move(row));
        }
        table.keep(used);
        CHECK(holds_rows(table, rows));
        for (int more = 0; more < 9; ++more) {
          rows.push_back(random_integer_row(random, width, giants));
          push_row(table, rows.back());
        }
        CHECK(holds_rows(table, rows));
      }
    }
  }
  IntegerRows none(3);
  none.keep({});
  CHECK(none.size() == 0);
}

TEST_CASE("a table of integers may begin with a giant") {
  IntegerRows table(2);
  const IntegerRow row{(Integer(1) << 9000) + 1, Integer(-3)};
  push_row(table, row);
  CHECK(holds_rows(table, {row}));
}

// Some of GMP's functions read the lowest limb of zero. Behind the last entry there may be no memory, which ended a
// reader of meshes by a signal where a table filled its pages.
TEST_CASE("a zero of a table of integers has a limb of its own") {
  IntegerRows table(3);
  push_row(table, {Integer(0), Integer(7), Integer(0)});
  push_row(table, {Integer(-5), Integer(0), Integer(0)});
  push_row(table, {Integer(0), Integer(0), Integer(0)});
  table.trim();
  std::size_t zeros = 0;
  for (std::uint32_t row = 0; row < table.size(); ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const IntegerView value = table.at(row, column);
      if (value.sign() != 0) continue;
      ++zeros;
      CHECK(mpz_limbs_read(value)[0] == 0);
      CHECK(mpz_get_si(value) == 0);
      CHECK(mpz_fits_slong_p(value) != 0);
    }
  }
  CHECK(zeros == 7);
}

}  // namespace nef::test
