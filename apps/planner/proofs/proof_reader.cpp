// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/proof_reader.h"

#include <limits>
#include <utility>
#include <vector>

#include "apps/program/reports/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;

constexpr std::uint32_t kProofVersion = 1;

}  // namespace

json pieces_json(const ProofPieces& pieces) {
  json result = json::array();
  for (const std::vector<Rational3>& piece : pieces) {
    json points = json::array();
    for (const Rational3& p : piece) points.push_back(exact_json(p));
    result.push_back(std::move(points));
  }
  return result;
}

Rational proof_number(const JsonReader& reader) {
  const json& value = reader.value();
  if (!value.is_string()) reader.fail("numbers are strings such as \"1/3\", not " + spelled(value));
  Rational result = reader.number();
  if (to_string(result) != value) {
    reader.fail("numbers are whole or fractions in lowest terms, not " + spelled(value));
  }
  return result;
}

Rational3 proof_point(const JsonReader& reader) { return reader.exactly<3>(proof_number); }

ProofPieces proof_pieces(const JsonReader& reader) {
  return reader.list([](const JsonReader& piece) { return piece.list(proof_point); });
}

std::uint32_t proof_index(const JsonReader& reader) {
  const json& value = reader.value();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    reader.fail("expected the number of an item, not " + spelled(value));
  }
  return value.get<std::uint32_t>();
}

std::string proof_frame(json claim, json witness) {
  const json root{{"nef_proof", kProofVersion}, {"claim", std::move(claim)}, {"witness", std::move(witness)}};
  return root.dump() + "\n";
}

void require_frame(const JsonReader& root) {
  root.require_keys({"nef_proof", "claim", "witness"});
  if (proof_index(root["nef_proof"]) != kProofVersion) {
    root.fail("unknown version of the format; this program reads version 1");
  }
}

}  // namespace nef::planner
