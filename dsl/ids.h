// Typed 32-bit ids and the flat tables they index. Used from the front end down to code generation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rg {

// An index into a Table<Id<Tag>, Row>. A default-constructed id is `none`.
template <class Tag>
struct Id {
  uint32_t value = UINT32_MAX;

  constexpr Id() = default;
  constexpr explicit Id(size_t index) : value(static_cast<uint32_t>(index)) {}
  constexpr bool valid() const { return value != UINT32_MAX; }
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;
};

// A vector whose index type says what it holds.
template <class IdType, class Row>
struct Table {
  std::vector<Row> rows;

  IdType add(Row row) {
    rows.push_back(std::move(row));
    return IdType{rows.size() - 1};
  }
  Row& operator[](IdType id) { return rows[id.value]; }
  const Row& operator[](IdType id) const { return rows[id.value]; }
  size_t size() const { return rows.size(); }
  bool empty() const { return rows.empty(); }
  auto begin() { return rows.begin(); }
  auto end() { return rows.end(); }
  auto begin() const { return rows.begin(); }
  auto end() const { return rows.end(); }
  friend bool operator==(const Table&, const Table&) = default;
};

}  // namespace rg
