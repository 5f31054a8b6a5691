// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/layers_file.h"

#include <utility>

#include "apps/planner/proofs/proof_reader.h"
#include "apps/program/reports/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;

json simplex_json(const PathProof::BlockedSimplex& simplex) {
  json result{{"corners", simplex.corners}};
  if (!simplex.hit) return result;
  json common = json::array();
  for (const Rational3& point : simplex.hit->common) common.push_back(exact_json(point));
  result["robot"] = simplex.hit->robot;
  result["obstacle"] = simplex.hit->obstacle;
  result["common"] = std::move(common);
  return result;
}

json simplices_json(const std::vector<PathProof::BlockedSimplex>& simplices) {
  json result = json::array();
  for (const PathProof::BlockedSimplex& simplex : simplices) result.push_back(simplex_json(simplex));
  return result;
}

PathProof::BlockedSimplex read_simplex(const JsonReader& simplex) {
  PathProof::BlockedSimplex result;
  if (simplex.has("robot")) {
    simplex.require_keys({"corners", "robot", "obstacle", "common"});
    result.hit = {proof_index(simplex["robot"]), proof_index(simplex["obstacle"]), simplex["common"].list(proof_point)};
  } else {
    simplex.require_keys({"corners"});
  }
  result.corners = simplex["corners"].list(proof_index);
  return result;
}

PathProof::Layer read_layer(const JsonReader& layer) {
  layer.require_keys({"until", "barrier", "closing"});
  return {proof_number(layer["until"]), layer["barrier"].list(read_simplex), layer["closing"].list(read_simplex)};
}

}  // namespace

json layers_json(const PathProof::Layers& layers) {
  json points = json::array();
  for (const Rational3& point : layers.points) points.push_back(exact_json(point));
  json charts = json::array();
  for (const std::vector<PathProof::Layer>& chart : layers.charts) {
    json& parts = charts.emplace_back(json::array());
    for (const PathProof::Layer& layer : chart) {
      parts.push_back({{"until", to_string(layer.until)},
                       {"barrier", simplices_json(layer.barrier)},
                       {"closing", simplices_json(layer.closing)}});
    }
  }
  return {{"points", std::move(points)}, {"charts", std::move(charts)}};
}

PathProof::Layers read_layers(const JsonReader& reader) {
  reader.require_keys({"points", "charts"});
  return {reader["points"].list(proof_point),
          reader["charts"].list([](const JsonReader& chart) { return chart.list(read_layer); })};
}

}  // namespace nef::planner
