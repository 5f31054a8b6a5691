// SPDX-License-Identifier: Apache-2.0
//
// One function writes and one reads each thing, in the order of path_proof.h. An object must have exactly the keys that
// are written, so that nothing in a proof is read over.
#include "apps/planner/proofs/proof_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>

#include "apps/program/exact_json.h"
#include "nef/base/error.h"
#include "nef/base/in_quotes.h"

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

// A value of a proof, and where it stands.
class Reader {
 public:
  Reader(const json& value, std::string where) : value_(value), where_(std::move(where)) {}

  // Requires an object with these keys and no others.
  void require_keys(std::initializer_list<const char*> keys) const {
    if (!value_.is_object()) fail("expected an object");
    for (const char* key : keys) {
      if (!value_.contains(key)) fail("'" + std::string(key) + "' is missing");
    }
    for (const auto& item : value_.items()) {
      const bool known = std::any_of(keys.begin(), keys.end(), [&](const char* key) { return item.key() == key; });
      if (!known) fail("unknown key " + in_quotes(item.key()));
    }
  }

  [[nodiscard]] bool has(const char* key) const { return value_.is_object() && value_.contains(key); }
  [[nodiscard]] bool is_null() const { return value_.is_null(); }
  [[nodiscard]] Reader operator[](const char* key) const { return {value_[key], where_ + ": " + key}; }

  template <class Make>
  [[nodiscard]] auto list(Make&& make) const {
    if (!value_.is_array()) fail("expected a list");
    std::vector<decltype(make(*this))> result;
    for (const json& entry : value_) result.push_back(make(Reader(entry, where_)));
    return result;
  }
  template <std::size_t kSize, class Make>
  [[nodiscard]] auto exactly(Make&& make) const {
    const auto all = list(make);
    if (all.size() != kSize) fail("expected a list of " + std::to_string(kSize));
    std::array<decltype(make(*this)), kSize> result{};
    std::copy(all.begin(), all.end(), result.begin());
    return result;
  }

  [[nodiscard]] Rational number() const {
    if (!value_.is_string()) fail("numbers are strings such as \"1/3\", not " + spelled(value_));
    Rational result = rational_of(value_, where_);
    if (to_string(result) != value_) fail("numbers are whole or fractions in lowest terms, not " + spelled(value_));
    return result;
  }
  [[nodiscard]] Rational3 point() const { return exactly<3>(&Reader::number_of); }
  [[nodiscard]] std::vector<Rational> numbers() const { return list(&Reader::number_of); }
  [[nodiscard]] ProofPieces pieces() const {
    return list([](const Reader& piece) { return piece.list([](const Reader& p) { return p.point(); }); });
  }
  [[nodiscard]] std::uint32_t index() const {
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
      fail("expected the number of an item, not " + spelled(value_));
    }
    return value_.get<std::uint32_t>();
  }
  // The number of one of these words.
  [[nodiscard]] std::size_t word(std::span<const char* const> words) const {
    const auto found = std::find_if(words.begin(), words.end(), [&](const char* word) { return value_ == word; });
    if (found == words.end()) fail("unknown word " + spelled(value_));
    return static_cast<std::size_t>(found - words.begin());
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(where_ + ": " + what); }

  static Rational number_of(const Reader& reader) { return reader.number(); }
  static Rational3 point_of(const Reader& reader) { return reader.point(); }
  static std::uint32_t index_of(const Reader& reader) { return reader.index(); }

 private:
  const json& value_;
  std::string where_;
};

RigidPose read_pose(const Reader& pose) {
  pose.require_keys({"position", "quaternion"});
  return {pose["position"].point(), pose["quaternion"].exactly<4>(&Reader::number_of)};
}

PathProof::Claim read_claim(const Reader& claim) {
  claim.require_keys({"status", "contact", "box", "robot", "obstacles", "path"});
  PathProof::Claim result;
  result.status = static_cast<Status>(claim["status"].word(kStatusNames));
  result.contact = static_cast<ContactRule>(claim["contact"].word(std::array{"allow", "forbid"}));
  if (!claim["box"].is_null()) result.box = claim["box"].exactly<2>(&Reader::point_of);
  result.robot = claim["robot"].pieces();
  result.obstacles = claim["obstacles"].pieces();
  result.path = claim["path"].list(read_pose);
  return result;
}

PathProof::Part read_part(const Reader& part) {
  part.require_keys({"until", "planes"});
  return {part["until"].number(), part["planes"].list([](const Reader& plane) {
            plane.require_keys({"robot", "obstacle", "normal"});
            return PathProof::Plane{plane["robot"].index(), plane["obstacle"].index(), plane["normal"].point()};
          })};
}

CommonPoint read_common(const Reader& point) {
  point.require_keys({"robot", "obstacle"});
  return {point["robot"].numbers(), point["obstacle"].numbers()};
}

PathProof::Triangle read_triangle(const Reader& triangle) {
  PathProof::Triangle result;
  if (triangle.has("robot")) {
    triangle.require_keys({"corners", "robot", "obstacle", "common"});
    result.hit = {triangle["robot"].index(), triangle["obstacle"].index(), triangle["common"].exactly<3>(read_common)};
  } else {
    triangle.require_keys({"corners"});
  }
  result.corners = triangle["corners"].exactly<3>(&Reader::index_of);
  return result;
}

PathProof::Barrier read_barrier(const Reader& barrier) {
  barrier.require_keys({"points", "triangles"});
  return {barrier["points"].list(&Reader::point_of), barrier["triangles"].list(read_triangle)};
}

PathProof::Collision read_collision(const Reader& collision) {
  collision.require_keys({"motion", "parameter", "times", "robot", "obstacle", "common"});
  PathProof::Collision result;
  result.motion = collision["motion"].index();
  result.parameter = collision["parameter"].number();
  result.times = collision["times"].exactly<2>(&Reader::number_of);
  result.robot = collision["robot"].index();
  result.obstacle = collision["obstacle"].index();
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
  if (root["nef_proof"].index() != kVersion) root.fail("unknown version of the format; this program reads version 1");
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
    proof.outside = witness["outside"].index();
  } else {
    witness.require_keys({"collision"});
    proof.collision = read_collision(witness["collision"]);
  }
  return proof;
}

}  // namespace nef::planner
