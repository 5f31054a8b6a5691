// SPDX-License-Identifier: Apache-2.0
//
// One function writes and one reads each thing, in the order of path_proof.h. An object must have exactly the keys that
// are written, so that nothing in a proof is read over.
#include "apps/planner/proofs/proof_file.h"

#include <array>
#include <span>
#include <utility>

#include "apps/planner/proofs/layers_file.h"
#include "apps/planner/proofs/pose_cells_file.h"
#include "apps/planner/proofs/proof_reader.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/program/reports/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;

using Status = PathProof::Claim::Status;

constexpr std::array kStatusNames{"path", "blocked", "infeasible", "tight"};  // in the order of Status

json claim_json(const PathProof::Claim& claim) {
  json path = json::array();
  for (const RigidPose& pose : claim.path) path.push_back(pose_json(pose));
  json result{{"status", status_word(claim.status)},
              {"contact", claim.contact == ContactRule::kAllow ? "allow" : "forbid"},
              {"box", claim.box ? json::array({exact_json((*claim.box)[0]), exact_json((*claim.box)[1])}) : json()},
              {"robot", pieces_json(claim.robot)},
              {"obstacles", pieces_json(claim.obstacles)},
              {"path", std::move(path)}};
  if (claim.status == Status::kTight) result["along"] = pieces_json(claim.along);
  if (claim.rotations) result["rotations"] = rotations_json(*claim.rotations);
  if (claim.places) result["places"] = *claim.places;
  return result;
}

json planes_json(const std::vector<PathProof::Plane>& planes) {
  json result = json::array();
  for (const PathProof::Plane& plane : planes) {
    result.push_back({{"robot", plane.robot}, {"obstacle", plane.obstacle}, {"normal", exact_json(plane.normal)}});
  }
  return result;
}

json motion_json(const std::vector<PathProof::Part>& parts) {
  json result = json::array();
  for (const PathProof::Part& part : parts) {
    result.push_back({{"until", to_string(part.until)}, {"planes", planes_json(part.planes)}});
  }
  return result;
}

json common_json(const CommonPoint& point) {
  return {{"robot", exact_json(point.robot)}, {"obstacle", exact_json(point.obstacle)}};
}

json common_json(std::span<const CommonPoint> points) {
  json common = json::array();
  for (const CommonPoint& point : points) common.push_back(common_json(point));
  return common;
}

json collision_json(const PathProof::Collision& collision) {
  return {{"motion", collision.motion},           {"parameter", to_string(collision.parameter)},
          {"times", exact_json(collision.times)}, {"robot", collision.robot},
          {"obstacle", collision.obstacle},       {"common", common_json(collision.common)}};
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

json cone_json(const PathProof::Tight::Cone& cone) {
  if (!cone.edge) return {{"contact", cone.contact}};
  return {{"edge", *cone.edge}, {"halves", {cone_json(cone.halves[0]), cone_json(cone.halves[1])}}};
}

json tight_json(const PathProof::Tight& tight) {
  json contacts = json::array();
  for (const PathProof::Tight::Contact& contact : tight.contacts) {
    if (contact.side) {
      contacts.push_back({{"side", *contact.side}});
    } else {
      contacts.push_back(
          {{"robot", contact.robot}, {"obstacle", contact.obstacle}, {"common", common_json(contact.common)}});
    }
  }
  json octants = json::array();
  for (const PathProof::Tight::Cone& cone : tight.octants) octants.push_back(cone_json(cone));
  return {{"planes", planes_json(tight.planes)}, {"contacts", std::move(contacts)}, {"octants", std::move(octants)}};
}

RigidPose read_pose(const JsonReader& pose) {
  pose.require_keys({"position", "quaternion"});
  return {proof_point(pose["position"]), pose["quaternion"].exactly<4>(proof_number)};
}

PathProof::Claim read_claim(const JsonReader& claim) {
  claim.require_keys({"status", "contact", "box", "robot", "obstacles", "path"}, {"along", "rotations", "places"});
  PathProof::Claim result;
  result.status = static_cast<Status>(claim["status"].word(kStatusNames));
  result.contact = static_cast<ContactRule>(claim["contact"].word(std::array{"allow", "forbid"}));
  if (!claim["box"].value().is_null()) result.box = claim["box"].exactly<2>(proof_point);
  result.robot = proof_pieces(claim["robot"]);
  result.obstacles = proof_pieces(claim["obstacles"]);
  result.path = claim["path"].list(read_pose);
  if (claim.has("along") != (result.status == Status::kTight))
    claim.fail("only a claim of tight passages has \"along\"");
  if (claim.has("along")) {
    result.along = claim["along"].list([](const JsonReader& vectors) { return vectors.list(proof_point); });
  }
  if (claim.has("rotations")) {
    if (result.status != Status::kInfeasible) claim.fail("only a claim of no path has \"rotations\"");
    result.rotations = read_rotations(claim["rotations"]);
  }
  if (claim.has("places")) {
    if (!result.rotations || result.rotations->empty())
      claim.fail("only a claim about a chain of rotations has \"places\"");
    result.places = claim["places"].exactly<2>(proof_index);
  }
  return result;
}

PathProof::Plane read_plane(const JsonReader& plane) {
  plane.require_keys({"robot", "obstacle", "normal"});
  return {proof_index(plane["robot"]), proof_index(plane["obstacle"]), proof_point(plane["normal"])};
}

PathProof::Part read_part(const JsonReader& part) {
  part.require_keys({"until", "planes"});
  return {proof_number(part["until"]), part["planes"].list(read_plane)};
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

PathProof::Tight::Contact read_tight_contact(const JsonReader& contact) {
  PathProof::Tight::Contact result;
  if (contact.has("side")) {
    contact.require_keys({"side"});
    result.side = proof_index(contact["side"]);
    return result;
  }
  contact.require_keys({"robot", "obstacle", "common"});
  return {proof_index(contact["robot"]), proof_index(contact["obstacle"]), read_common(contact["common"]), {}};
}

PathProof::Tight::Cone read_tight_cone(const JsonReader& cone) {
  PathProof::Tight::Cone result;
  if (cone.has("edge")) {
    cone.require_keys({"edge", "halves"});
    result.edge = proof_index(cone["edge"]);
    auto halves = cone["halves"].exactly<2>(read_tight_cone);
    for (PathProof::Tight::Cone& half : halves) result.halves.push_back(std::move(half));
    return result;
  }
  cone.require_keys({"contact"});
  result.contact = proof_index(cone["contact"]);
  return result;
}

PathProof::Tight read_tight(const JsonReader& tight) {
  tight.require_keys({"planes", "contacts", "octants"});
  return {tight["planes"].list(read_plane), tight["contacts"].list(read_tight_contact),
          tight["octants"].exactly<8>(read_tight_cone)};
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
  if (proof.cells) witness["cells"] = pose_cells_json(*proof.cells, proof.claim.box.has_value());
  if (proof.layers) witness["layers"] = layers_json(*proof.layers);
  if (proof.claim.status == Status::kTight) {
    witness["places"] = json::array();
    for (const PathProof::Tight& tight : proof.tight) witness["places"].push_back(tight_json(tight));
  }
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
  } else if (proof.claim.rotations && !proof.claim.rotations->empty()) {
    witness.require_keys({"layers"});
    proof.layers = read_layers(witness["layers"]);
  } else if (proof.claim.rotations) {
    witness.require_keys({"cells"});
    proof.cells = read_pose_cells(witness["cells"], proof.claim.box.has_value());
  } else if (proof.claim.status == Status::kInfeasible) {
    witness.require_keys({"barrier"});
    proof.barrier = read_barrier(witness["barrier"]);
  } else if (proof.claim.status == Status::kTight) {
    witness.require_keys({"places"});
    proof.tight = witness["places"].list(read_tight);
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
