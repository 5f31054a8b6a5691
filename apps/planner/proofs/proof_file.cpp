// SPDX-License-Identifier: Apache-2.0
//
// One function writes and one reads each thing, in the order of path_proof.h. An object must have exactly the keys that
// are written, so that nothing in a proof is read over.
#include "apps/planner/proofs/proof_file.h"

#include <array>
#include <span>
#include <utility>

#include "apps/planner/proofs/proof_reader.h"
#include "apps/program/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;

using Status = PathProof::Claim::Status;

constexpr std::array kStatusNames{"path", "blocked", "infeasible"};  // in the order of Status

json claim_json(const PathProof::Claim& claim) {
  json path = json::array();
  for (const RigidPose& pose : claim.path) {
    path.push_back({{"position", exact_json(pose.position)}, {"quaternion", numbers_json(pose.quaternion)}});
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
          {"times", numbers_json(collision.times)},
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

RigidPose read_pose(const JsonReader& pose) {
  pose.require_keys({"position", "quaternion"});
  return {proof_point(pose["position"]), pose["quaternion"].exactly<4>(proof_number)};
}

PathProof::Claim read_claim(const JsonReader& claim) {
  claim.require_keys({"status", "contact", "box", "robot", "obstacles", "path"});
  PathProof::Claim result;
  result.status = static_cast<Status>(claim["status"].word(kStatusNames));
  result.contact = static_cast<ContactRule>(claim["contact"].word(std::array{"allow", "forbid"}));
  if (!claim["box"].value().is_null()) result.box = claim["box"].exactly<2>(proof_point);
  result.robot = proof_pieces(claim["robot"]);
  result.obstacles = proof_pieces(claim["obstacles"]);
  result.path = claim["path"].list(read_pose);
  return result;
}

PathProof::Part read_part(const JsonReader& part) {
  part.require_keys({"until", "planes"});
  return {proof_number(part["until"]), part["planes"].list([](const JsonReader& plane) {
            plane.require_keys({"robot", "obstacle", "normal"});
            return PathProof::Plane{proof_index(plane["robot"]), proof_index(plane["obstacle"]),
                                    proof_point(plane["normal"])};
          })};
}

CommonPoint read_common(const JsonReader& point) {
  point.require_keys({"robot", "obstacle"});
  return {point["robot"].list(proof_number), point["obstacle"].list(proof_number)};
}

PathProof::Triangle read_triangle(const JsonReader& triangle) {
  PathProof::Triangle result;
  if (triangle.has("robot")) {
    triangle.require_keys({"corners", "robot", "obstacle", "common"});
    result.hit = {proof_index(triangle["robot"]), proof_index(triangle["obstacle"]),
                  triangle["common"].exactly<3>(read_common)};
  } else {
    triangle.require_keys({"corners"});
  }
  result.corners = triangle["corners"].exactly<3>(proof_index);
  return result;
}

PathProof::Barrier read_barrier(const JsonReader& barrier) {
  barrier.require_keys({"points", "triangles"});
  return {barrier["points"].list(proof_point), barrier["triangles"].list(read_triangle)};
}

PathProof::Collision read_collision(const JsonReader& collision) {
  collision.require_keys({"motion", "parameter", "times", "robot", "obstacle", "common"});
  PathProof::Collision result;
  result.motion = proof_index(collision["motion"]);
  result.parameter = proof_number(collision["parameter"]);
  result.times = collision["times"].exactly<2>(proof_number);
  result.robot = proof_index(collision["robot"]);
  result.obstacle = proof_index(collision["obstacle"]);
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
  return proof_frame(claim_json(proof.claim), std::move(witness));
}

bool is_proof_text(const std::string& text) { return text.find("\"claim\"") != std::string::npos; }

PathProof parse_proof(const std::string& text, const std::string& name) {
  const json value = parse_exact_json(text, name);
  const JsonReader root(value, name);
  require_frame(root);
  PathProof proof;
  proof.claim = read_claim(root["claim"]);
  const JsonReader witness = root["witness"];
  if (proof.claim.status == Status::kFree) {
    witness.require_keys({"motions"});
    proof.motions = witness["motions"].list([](const JsonReader& motion) { return motion.list(read_part); });
  } else if (proof.claim.status == Status::kInfeasible) {
    witness.require_keys({"barrier"});
    proof.barrier = read_barrier(witness["barrier"]);
  } else if (witness.has("outside")) {
    witness.require_keys({"outside"});
    proof.outside = proof_index(witness["outside"]);
  } else {
    witness.require_keys({"collision"});
    proof.collision = read_collision(witness["collision"]);
  }
  return proof;
}

}  // namespace nef::planner
