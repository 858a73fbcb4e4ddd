// Proofs. Beside every fact stands the set of atoms (barriers, waits, signals, single bits of their masks) that all its derivations use. A fact that
// has a derivation without an atom survives its removal: sets of alternative derivations intersect, sets of joint premises unite.
// An atom that no proof of any necessary fact contains is redundant.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace rg::verify {

using Atom = uint32_t;
using Proof = std::vector<Atom>;  // sorted

enum class AtomField : uint8_t { whole, src_stage, src_access, dst_stage, dst_access, value };
constexpr uint32_t kAtomsOfScope = 6 * 64;
constexpr Atom atom_of(uint32_t scope, AtomField field, uint32_t bit = 0) { return scope * kAtomsOfScope + static_cast<uint32_t>(field) * 64 + bit; }
constexpr uint32_t scope_of(Atom atom) { return atom / kAtomsOfScope; }

Proof unite(const Proof& a, const Proof& b);
void intersect(Proof& a, const Proof& b);
void subtract(Proof& a, const Proof& b);
bool contains(const Proof& a, const Proof& b);  // b is a part of a

// Alternative derivations of one fact; none yet means that it does not hold.
struct Alternatives {
  std::optional<Proof> proof;
  void add(Proof next);
};

}  // namespace rg::verify
