// SPDX-License-Identifier: Apache-2.0
//
// One function writes and one reads each thing, in the order of path_proof.h. An object must have exactly the keys that
// are written, so that nothing in a proof is read over.
#include "apps/planner/proofs/proof_file.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "apps/program/exact_json.h"
#include "apps/program/json_reader.h"

namespace nef::planner {
namespace {

using nlohmann::json;

constexpr std::uint32_t kVersion = 1;

json numbers_json(const std::vector<Rational>& numbers) {
  json result = json::array();
  for (const Rational& x : numbers) result.push_back(to_string(x));
  return result;
}

json pieces_json(const ProofPieces& pieces) {
  json result = json::array();
  for (const std::vector<Rational3>& piece : pieces) {
    json points = json::array();
    for (const Rational3& p : piece) points.push_back(exact_json(p));
    result.push_back(std::move(points));
  }
  return result;
}

using Status = PathProof::Claim::Status;

constexpr std::array kStatusNames{"path", "blocked", "infeasible"};  // in the order of Status

json claim_json(const PathProof::Claim& claim) {
  json path = json::array();
  for (const RigidPose& pose : claim.path) {
    path.push_back({{"position", exact_json(pose.position)},
                    {"quaternion", numbers_json({pose.quaternion.begin(), pose.quaternion.end()})}});
  }
  return {{"status", status_word(claim.status)},
          {"contact", claim.contact == ContactRule::kAllow ? "allow" : "forbid"},
          {"box", claim.box ? json::array({exact_json((*claim.box)[0]), exact_json((*claim.box)[1])}) : json()},
          {"robot", pieces_json(claim.robot)},
          {"obstacles", pieces_json(claim.obstacles)},
          {"path", std::move(path)}};
}

json motion_json(const std::vector<PathProof::Part>& parts) {
  json result = json::array();
  for (const PathProof::Part& part : parts) {
    json planes = json::array();
    for (const PathProof::Plane& plane : part.planes) {
      planes.push_back({{"robot", plane.robot}, {"obstacle", plane.obstacle}, {"normal", exact_json(plane.normal)}});
    }
    result.push_back({{"until", to_string(part.until)}, {"planes", std::move(planes)}});
  }
  return result;
}

json common_json(std::span<const CommonPoint> points) {
  json common = json::array();
  for (const CommonPoint& point : points) {
    common.push_back({{"robot", numbers_json(point.robot)}, {"obstacle", numbers_json(point.obstacle)}});
  }
  return common;
}

json collision_json(const PathProof::Collision& collision) {
  return {{"motion", collision.motion},
          {"parameter", to_string(collision.parameter)},
          {"times", numbers_json({collision.times.begin(), collision.times.end()})},
          {"robot", collision.robot},
          {"obstacle", collision.obstacle},
          {"common", common_json(collision.common)}};
}

json barrier_json(const PathProof::Barrier& barrier) {
  json points = json::array();
  for (const Rational3& p : barrier.points) points.push_back(exact_json(p));
  json triangles = json::array();
  for (const PathProof::Triangle& triangle : barrier.triangles) {
    json entry{{"corners", triangle.corners}};
    if (triangle.hit) {
      entry["robot"] = triangle.hit->robot;
      entry["obstacle"] = triangle.hit->obstacle;
      entry["common"] = common_json(triangle.hit->common);
    }
    triangles.push_back(std::move(entry));
  }
  return {{"points", std::move(points)}, {"triangles", std::move(triangles)}};
}

using Reader = JsonReader;

Rational number_of(const Reader& reader) {
  const json& value = reader.value();
  if (!value.is_string()) reader.fail("numbers are strings such as \"1/3\", not " + spelled(value));
  Rational result = reader.number();
  if (to_string(result) != value) {
    reader.fail("numbers are whole or fractions in lowest terms, not " + spelled(value));
  }
  return result;
}

Rational3 point_of(const Reader& reader) { return reader.exactly<3>(number_of); }

std::uint32_t index_of(const Reader& reader) {
  const json& value = reader.value();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    reader.fail("expected the number of an item, not " + spelled(value));
  }
  return value.get<std::uint32_t>();
}

ProofPieces pieces_of(const Reader& reader) {
  return reader.list([](const Reader& piece) { return piece.list(point_of); });
}

RigidPose read_pose(const Reader& pose) {
  pose.require_keys({"position", "quaternion"});
  return {point_of(pose["position"]), pose["quaternion"].exactly<4>(number_of)};
}

PathProof::Claim read_claim(const Reader& claim) {
  claim.require_keys({"status", "contact", "box", "robot", "obstacles", "path"});
  PathProof::Claim result;
  result.status = static_cast<Status>(claim["status"].word(kStatusNames));
  result.contact = static_cast<ContactRule>(claim["contact"].word(std::array{"allow", "forbid"}));
  if (!claim["box"].value().is_null()) result.box = claim["box"].exactly<2>(point_of);
  result.robot = pieces_of(claim["robot"]);
  result.obstacles = pieces_of(claim["obstacles"]);
  result.path = claim["path"].list(read_pose);
  return result;
}

PathProof::Part read_part(const Reader& part) {
  part.require_keys({"until", "planes"});
  return {number_of(part["until"]), part["planes"].list([](const Reader& plane) {
            plane.require_keys({"robot", "obstacle", "normal"});
            return PathProof::Plane{index_of(plane["robot"]), index_of(plane["obstacle"]), point_of(plane["normal"])};
          })};
}

CommonPoint read_common(const Reader& point) {
  point.require_keys({"robot", "obstacle"});
  return {point["robot"].list(number_of), point["obstacle"].list(number_of)};
}

PathProof::Triangle read_triangle(const Reader& triangle) {
  PathProof::Triangle result;
  if (triangle.has("robot")) {
    triangle.require_keys({"corners", "robot", "obstacle", "common"});
    result.hit = {index_of(triangle["robot"]), index_of(triangle["obstacle"]),
                  triangle["common"].exactly<3>(read_common)};
  } else {
    triangle.require_keys({"corners"});
  }
  result.corners = triangle["corners"].exactly<3>(index_of);
  return result;
}

PathProof::Barrier read_barrier(const Reader& barrier) {
  barrier.require_keys({"points", "triangles"});
  return {barrier["points"].list(point_of), barrier["triangles"].list(read_triangle)};
}

PathProof::Collision read_collision(const Reader& collision) {
  collision.require_keys({"motion", "parameter", "times", "robot", "obstacle", "common"});
  PathProof::Collision result;
  result.motion = index_of(collision["motion"]);
  result.parameter = number_of(collision["parameter"]);
  result.times = collision["times"].exactly<2>(number_of);
  result.robot = index_of(collision["robot"]);
  result.obstacle = index_of(collision["obstacle"]);
  result.common = collision["common"].exactly<2>(read_common);
  return result;
}

}  // namespace

const char* status_word(PathProof::Claim::Status status) { return kStatusNames.at(static_cast<std::size_t>(status)); }

std::string proof_text(const PathProof& proof) {
  json witness;
  if (proof.claim.status == Status::kFree) {
    witness["motions"] = json::array();
    for (const std::vector<PathProof::Part>& parts : proof.motions) witness["motions"].push_back(motion_json(parts));
  }
  if (proof.collision) witness["collision"] = collision_json(*proof.collision);
  if (proof.outside) witness["outside"] = *proof.outside;
  if (proof.barrier) witness["barrier"] = barrier_json(*proof.barrier);
  const json root{{"nef_proof", kVersion}, {"claim", claim_json(proof.claim)}, {"witness", std::move(witness)}};
  return root.dump() + "\n";
}

bool is_proof_text(const std::string& text) { return text.find("\"claim\"") != std::string::npos; }

PathProof parse_proof(const std::string& text, const std::string& name) {
  const json value = parse_exact_json(text, name);
  const Reader root(value, name);
  root.require_keys({"nef_proof", "claim", "witness"});
  if (index_of(root["nef_proof"]) != kVersion) root.fail("unknown version of the format; this program reads version 1");
  PathProof proof;
  proof.claim = read_claim(root["claim"]);
  const Reader witness = root["witness"];
  if (proof.claim.status == Status::kFree) {
    witness.require_keys({"motions"});
    proof.motions = witness["motions"].list([](const Reader& motion) { return motion.list(read_part); });
  } else if (proof.claim.status == Status::kInfeasible) {
    witness.require_keys({"barrier"});
    proof.barrier = read_barrier(witness["barrier"]);
  } else if (witness.has("outside")) {
    witness.require_keys({"outside"});
    proof.outside = index_of(witness["outside"]);
  } else {
    witness.require_keys({"collision"});
    proof.collision = read_collision(witness["collision"]);
  }
  return proof;
}

}  // namespace nef::planner
