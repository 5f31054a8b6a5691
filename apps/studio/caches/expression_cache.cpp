// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/caches/expression_cache.h"

#include <algorithm>

namespace nef::studio {
namespace {

// Small tiles are found and sent fast, large ones are few to draw.
constexpr std::size_t kVerticesOfTile = 256;

bool keeps_bounded(BooleanOperator op, const Polyhedron& set) {
  return op == BooleanOperator::kIntersection || op == BooleanOperator::kDifference || set.is_bounded();
}

}  // namespace

ExpressionCache::Value ExpressionCache::operand(ExpressionSteps& steps, std::size_t i, const std::string& way,
                                                const ExpressionOptions& options, const std::vector<FileState>& files,
                                                Messages& told) {
  const std::string key = way + ' ' + steps.key(i);
  if (std::optional<Value> kept = small_.find(key)) return *std::move(kept);
  if (std::optional<Value> kept = large_.find(key)) return *std::move(kept);
  // What is told of a variable is told once, with the first set that is made of it.
  if (!steps.has_variables(i)) told.clear();
  Value value;
  value.set = steps.set(i, options);
  value.messages = told;
  auto& kept = value.set.complex().vertex_count() < kLargeSet ? small_ : large_;
  kept.keep(key, files, value);
  return value;
}

std::optional<TiledPolyhedron> ExpressionCache::in_tiles(const ExpressionSteps& steps,
                                                         const std::vector<Polyhedron>& sets,
                                                         const std::vector<std::vector<FileState>>& files,
                                                         const std::string& way, const Monitor& monitor) {
  if (sets[0].complex().vertex_count() < kLargeSet || !sets[0].is_bounded()) return std::nullopt;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].complex().label_count > 2) return std::nullopt;
    if (i > 0 && !keeps_bounded(steps.operation(i), sets[i])) return std::nullopt;
  }
  std::vector<std::string> keys{way + ' ' + steps.key(0)};
  for (std::size_t i = 1; i < sets.size(); ++i) {
    keys.push_back(keys.back() + static_cast<char>('a' + static_cast<int>(steps.operation(i))) + steps.key(i));
  }
  std::optional<TiledPolyhedron> set;
  std::size_t next = sets.size();
  while (next > 0 && !set) set = tiled_.find(keys[--next]);
  std::vector<FileState> read;
  for (std::size_t i = 0; i < next; ++i) read.insert(read.end(), files[i].begin(), files[i].end());
  if (!set) set.emplace(sets[0], Tiling{.limit = kVerticesOfTile}, monitor);
  read.insert(read.end(), files[next].begin(), files[next].end());
  tiled_.keep(keys[next], read, *set);
  for (std::size_t i = next + 1; i < sets.size(); ++i) {
    monitor.check_interruption();
    StepSequence sequence(*std::move(set), 1);
    sequence.apply(steps.operation(i), sets[i], monitor);
    set = sequence.tiled({.limit = kVerticesOfTile}, monitor);
    read.insert(read.end(), files[i].begin(), files[i].end());
    if (i + 2 >= sets.size()) tiled_.keep(keys[i], read, *set);
  }
  return set;
}

ExpressionCache::Result ExpressionCache::evaluate(const std::string& text, const std::string& way,
                                                  const ExpressionOptions& options, Messages& told,
                                                  const StateOfFile& state_of_file, bool tiles, Messages& messages) {
  const auto add_once = [&messages](const Messages& some) {
    for (const std::string& line : some) {
      if (std::find(messages.begin(), messages.end(), line) == messages.end()) messages.push_back(line);
    }
  };
  ExpressionSteps steps(text);
  std::vector<Polyhedron> sets;
  std::vector<std::vector<FileState>> files(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const std::string& name : steps.files(i)) files[i].push_back(state_of_file(name));
    Value value = operand(steps, i, way, options, files[i], told);
    add_once(value.messages);
    sets.push_back(std::move(value.set));
  }
  Result result;
  if (tiles) result.tiled = in_tiles(steps, sets, files, way, options.monitor);
  if (!result.tiled) result.whole = steps.combined(sets, options);
  result.shapes = std::move(sets);
  return result;
}

}  // namespace nef::studio
