// SPDX-License-Identifier: Apache-2.0
//
// Unions of neighbours, two results at a time, until one is left.
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "apps/nef_mpi/distributed_union.h"
#include "nef/io/file_bytes.h"
#include "nef/io/native/native_binary.h"

namespace nef::mpi {
namespace {

std::string result_name(std::size_t node) { return "union-" + std::to_string(node) + ".nef"; }

// How many neighbourhoods there are: tasks of some tenths of a second, many for any number of ranks, but none of few
// pieces. The same for any number of ranks, so that a second run may have another one.
std::size_t neighbourhoods(std::span<const UnionOperand> operands) {
  constexpr std::size_t kWeight = 24000;  // 2000 tetrahedra
  constexpr std::size_t kTasks = 64;
  constexpr std::size_t kLeastPieces = 16;
  std::size_t weight = 0;
  for (const UnionOperand& operand : operands) weight += operand.weight;
  return std::max<std::size_t>({weight / kWeight, std::min(kTasks, operands.size() / kLeastPieces), std::size_t{1}});
}

// The tasks as nodes of a tree: neighbourhoods, then unions of two, children first; the root is the last one.
class UnionTree {
 public:
  UnionTree(const WorkFolder& work, const MeasuredPieces& pieces)
      : work_(work), pieces_(pieces), order_(pieces.operands, neighbourhoods(pieces.operands)) {
    const auto operands = static_cast<std::uint32_t>(pieces.operands.size());
    std::map<std::uint32_t, std::size_t> node_of_result;
    for (const UnionOrder::Task& task : order_.tasks()) {
      Node& node = nodes_.emplace_back();
      for (std::uint32_t k = task.first; k < task.last; ++k) {
        for (const std::uint32_t i : {order_.steps()[k].first, order_.steps()[k].second}) {
          if (i < operands) node.pieces.push_back(i);
        }
      }
      node_of_result[operands + task.last - 1] = nodes_.size() - 1;
    }
    for (const std::vector<std::uint32_t>& round : order_.rounds()) {
      for (const std::uint32_t k : round) {
        Node node;
        for (const std::uint32_t i : {order_.steps()[k].first, order_.steps()[k].second}) {
          if (i < operands) {
            node.pieces.push_back(i);
          } else {
            node.nodes.push_back(node_of_result.at(i));
          }
        }
        nodes_.push_back(std::move(node));
        node_of_result[operands + k] = nodes_.size() - 1;
      }
    }
    // A single piece.
    if (nodes_.empty()) nodes_.push_back({{0}, {}});
  }

  [[nodiscard]] std::size_t root() const { return nodes_.size() - 1; }
  [[nodiscard]] const std::vector<std::size_t>& needs(std::size_t node) const { return nodes_[node].nodes; }

  // Which nodes an earlier run has done, or has done what they are needed for.
  [[nodiscard]] std::vector<bool> finished() const {
    std::vector<bool> result(nodes_.size(), false);
    for (std::size_t node = nodes_.size(); node-- > 0;) {
      if (work_.has(result_name(node))) result[node] = true;
      for (const std::size_t child : nodes_[node].nodes) result[child] = result[node];
    }
    return result;
  }

  // To the work folder.
  void make(std::size_t node) {
    Polyhedron set = unite_at(node, {});
    write_file(work_ / result_name(node), native_binary(set));
    last_ = {node, std::move(set)};
  }

  Polyhedron unite_at(std::size_t node, const Monitor& monitor) {
    std::vector<Polyhedron> sets;
    for (const std::uint32_t piece : nodes_[node].pieces) sets.push_back(pieces_.source.set(piece, {}));
    for (const std::size_t child : nodes_[node].nodes) sets.push_back(result(child));
    return unite_all(sets, monitor);
  }

  // What has gone into a node is not needed any more.
  void remove_children(std::size_t node) const {
    for (const std::size_t child : nodes_[node].nodes) work_.remove(result_name(child));
  }

  [[nodiscard]] std::string name(std::size_t node) const {
    if (!nodes_[node].nodes.empty()) return "union " + std::to_string(node + 1);
    const auto [low, high] = std::minmax_element(nodes_[node].pieces.begin(), nodes_[node].pieces.end());
    return "the union of " + std::to_string(nodes_[node].pieces.size()) + " of the pieces " + std::to_string(*low + 1) +
           " to " + std::to_string(*high + 1);
  }

 private:
  struct Node {
    std::vector<std::uint32_t> pieces;
    std::vector<std::size_t> nodes;
  };

  Polyhedron result(std::size_t node) {
    if (last_ && last_->first == node) return std::exchange(last_, std::nullopt)->second;
    const std::string path = work_ / result_name(node);
    return read_native_binary(read_file(path), path);
  }

  const WorkFolder& work_;
  const MeasuredPieces& pieces_;
  UnionOrder order_;
  std::vector<Node> nodes_;
  std::optional<std::pair<std::size_t, Polyhedron>> last_;  // what this rank has made last
};

}  // namespace

Polyhedron union_up_a_tree(const Environment& mpi, const WorkFolder& work, const MeasuredPieces& pieces,
                           const Watcher& watcher) {
  UnionTree tree(work, pieces);
  const std::vector<bool> finished = mpi.first() ? tree.finished() : std::vector<bool>();
  do_tasks(mpi,
           {.name = "unions",
            .count = tree.root(),  // but the root
            .finished = [&](std::size_t node) { return finished[node]; },
            .name_of_task = [&](std::size_t node) { return tree.name(node); },
            .task =
                [&](std::size_t node) {
                  tree.make(node);
                  return std::string();
                },
            .done = [&](std::size_t node, const std::string&, double) { tree.remove_children(node); },
            .needs = [&](std::size_t node) { return tree.needs(node); }},
           watcher);
  return mpi.first() ? tree.unite_at(tree.root(), watcher.monitor) : Polyhedron();
}

}  // namespace nef::mpi
