// SPDX-License-Identifier: Apache-2.0
//
// One function writes and one reads each thing, in the order of inseparable_proof.h.
#include <array>
#include <utility>

#include "apps/planner/proofs/inseparable_proof.h"
#include "apps/planner/proofs/proof_reader.h"
#include "apps/program/reports/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;
using PieceContact = InseparableProof::Contact;
using DirectionCone = InseparableProof::Cone;

json contact_json(const PieceContact& contact) {
  return {{"first", {contact.first.part, contact.first.piece}},
          {"second", {contact.second.part, contact.second.piece}},
          {"common", {{"first", exact_json(contact.common.robot)}, {"second", exact_json(contact.common.obstacle)}}}};
}

json cone_json(const DirectionCone& cone) {
  if (cone.edge) {
    return {{"edge", *cone.edge}, {"halves", {cone_json(cone.halves[0]), cone_json(cone.halves[1])}}};
  }
  return {{"first_blocked", cone.first_blocked}, {"second_blocked", cone.second_blocked}};
}

std::string text_of(const JsonReader& reader) {
  if (!reader.value().is_string()) reader.fail("expected a text, not " + spelled(reader.value()));
  return reader.value().get<std::string>();
}

PieceContact::Piece read_piece(const JsonReader& piece) {
  const auto numbers = piece.exactly<2>(proof_index);
  return {numbers[0], numbers[1]};
}

PieceContact read_contact(const JsonReader& contact) {
  contact.require_keys({"first", "second", "common"});
  const JsonReader common = contact["common"];
  common.require_keys({"first", "second"});
  return {read_piece(contact["first"]), read_piece(contact["second"]),
          CommonPoint{common["first"].list(proof_number), common["second"].list(proof_number)}};
}

DirectionCone read_cone(const JsonReader& cone) {
  DirectionCone result;
  if (cone.has("edge")) {
    cone.require_keys({"edge", "halves"});
    result.edge = proof_index(cone["edge"]);
    auto halves = cone["halves"].exactly<2>(read_cone);
    for (DirectionCone& half : halves) result.halves.push_back(std::move(half));
    return result;
  }
  cone.require_keys({"first_blocked", "second_blocked"});
  result.first_blocked = cone["first_blocked"].list(proof_index);
  result.second_blocked = cone["second_blocked"].list(proof_index);
  return result;
}

}  // namespace

std::string proof_text(const InseparableProof& proof) {
  json parts = json::array();
  for (const InseparableProof::Part& part : proof.parts) {
    parts.push_back({{"name", part.name}, {"pieces", pieces_json(part.pieces)}});
  }
  json contacts = json::array();
  for (const PieceContact& contact : proof.contacts) contacts.push_back(contact_json(contact));
  json octants = json::array();
  for (const DirectionCone& cone : proof.octants) octants.push_back(cone_json(cone));
  return proof_frame({{"status", "inseparable"}, {"parts", std::move(parts)}},
                     {{"contacts", std::move(contacts)}, {"octants", std::move(octants)}});
}

InseparableProof parse_inseparable_proof(const std::string& text, const std::string& name) {
  const json value = parse_exact_json(text, name);
  const JsonReader root(value, name);
  require_frame(root);
  const JsonReader claim = root["claim"];
  claim.require_keys({"status", "parts"});
  (void)claim["status"].word(std::array{"inseparable"});
  InseparableProof proof;
  proof.parts = claim["parts"].list([](const JsonReader& part) {
    part.require_keys({"name", "pieces"});
    return InseparableProof::Part{text_of(part["name"]), proof_pieces(part["pieces"])};
  });
  const JsonReader witness = root["witness"];
  witness.require_keys({"contacts", "octants"});
  proof.contacts = witness["contacts"].list(read_contact);
  proof.octants = witness["octants"].exactly<8>(read_cone);
  return proof;
}

}  // namespace nef::planner
