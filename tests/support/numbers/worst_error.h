// SPDX-License-Identifier: Apache-2.0
//
// Looks for the worst case of a bound of rounding errors: hill climbing over the bits of integers, of which coordinates
// are made, for the largest error as a part of its bound.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "nef/number/number.h"

namespace nef::test {

/// The numbers of which a case is made.
using Genes = std::vector<Integer>;

/// A number of so many bits, of either sign.
inline Integer random_gene(std::mt19937_64& random, unsigned bits) {
  std::uint64_t value = random() >> (64 - bits);
  // Long runs of ones and zeros are what is cut off most, and least.
  if (random() % 3 == 0) value |= random() >> (64 - bits) | random() >> (64 - bits) | random() >> (64 - bits);
  value |= std::uint64_t{1} << (bits - 1);
  const Integer size(std::to_string(value));
  return random() % 2 == 0 ? size : Integer(-size);
}

/// The largest value of `part` that restarts and mutations find.
inline double worst(std::uint64_t seed, std::size_t genes, unsigned bits,
                    const std::function<double(const Genes&)>& part, int starts = 25) {
  constexpr int kSteps = 200;
  std::mt19937_64 random(seed);
  double all = 0;
  for (int start = 0; start < starts; ++start) {
    Genes best;
    for (std::size_t i = 0; i < genes; ++i) best.push_back(random_gene(random, bits));
    double score = part(best);
    for (int step = 0; step < kSteps; ++step) {
      Genes next = best;
      Integer& gene = next[random() % genes];
      if (random() % 4 == 0) {
        gene = random_gene(random, bits);
      } else {
        mpz_combit(gene.get_mpz_t(), random() % (bits - 1));
      }
      const double its = part(next);
      if (!(its >= score)) continue;
      score = its;
      best = std::move(next);
    }
    all = std::max(all, score);
  }
  return all;
}

/// An error as a part of its bound.
inline double part_of(const Rational& off, double bound) {
  return nearest_double(Rational(abs(off) / exact_rational(bound)));
}

/// Three quotients of genes as a point: those from `first` on, over the gene `below`.
inline Rational3 point_of_genes(const Genes& g, std::size_t first, std::size_t below) {
  return {Rational(g[first]) / g[below], Rational(g[first + 1]) / g[below], Rational(g[first + 2]) / g[below]};
}

}  // namespace nef::test
