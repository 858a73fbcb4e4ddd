#include "runtime/plan_interface.h"

#include <string>

namespace rg {

namespace {

// Collects the first difference; later calls are free.
class Comparison {
 public:
  Comparison(const Plan& built, const Plan& loaded) : built_(built), loaded_(loaded) {}

  void that(bool holds, std::string_view kind, std::string_view name, std::string_view what) {
    if (holds || !difference_.empty()) return;
    difference_.append("the plan of `").append(loaded_.name).append("` does not fit this program: ");
    difference_.append(kind).append(" `").append(name).append("` ").append(what);
    difference_.append("; build the program again with the generated code of the plan");
  }
  // Rows of one index have one name; the loaded plan has at most as many.
  template <class Row, class Same>
  void rows(std::span<const Row> built, std::span<const Row> loaded, std::string_view kind, Same same) {
    for (size_t i = 0; i < loaded.size(); ++i) {
      that(i < built.size(), kind, loaded[i].name, "is new");
      if (!difference_.empty()) return;
      that(built[i].name == loaded[i].name, kind, loaded[i].name, "stands where `" + std::string(built[i].name) + "` was");
      that(same(built[i], loaded[i]), kind, loaded[i].name, "changed");
    }
  }
  const Plan& built() const { return built_; }
  const Plan& loaded() const { return loaded_; }
  Status status() const { return difference_.empty() ? Status(Done{}) : Status(Error{ErrorCode::invalid_argument, difference_}); }

 private:
  const Plan& built_;
  const Plan& loaded_;
  std::string difference_;
};

const Resource* import_at(const Plan& plan, Index slot) {
  for (const Resource& resource : plan.resources)
    if (resource.lifetime == Lifetime::imported && resource.import_slot == slot) return &resource;
  return nullptr;
}

void compare_imports(Comparison& c) {
  for (const Resource& loaded : c.loaded().resources) {
    if (loaded.lifetime != Lifetime::imported) continue;
    const Resource* built = import_at(c.built(), loaded.import_slot);
    c.that(built != nullptr, "import", loaded.name, "is new");
    if (built == nullptr) return;
    c.that(built->name == loaded.name, "import", loaded.name, "stands where `" + std::string(built->name) + "` was");
    c.that(built->kind == loaded.kind, "import", loaded.name, "is another kind of resource");
    c.that(
        built->format == loaded.format && built->dimension == loaded.dimension && built->layers == loaded.layers && built->samples == loaded.samples,
        "import", loaded.name, "has another format or shape");
    c.that(built->layout == loaded.layout && built->stride == loaded.stride, "import", loaded.name, "has elements of another layout");
    // Flags that its creator gave it because the plan asked for them.
    c.that((loaded.usage & ~built->usage) == 0, "import", loaded.name, "is used in ways that it was not created for");
  }
}

const Pass* host_pass_at(const Plan& plan, Index slot) {
  for (const Pass& pass : plan.passes)
    if (pass.work.kind == WorkKind::host && pass.host_slot == slot) return &pass;
  return nullptr;
}

void compare_callbacks(Comparison& c) {
  for (const Pass& loaded : c.loaded().passes) {
    if (loaded.work.kind != WorkKind::host) continue;
    const Pass* built = host_pass_at(c.built(), loaded.host_slot);
    c.that(built != nullptr, "host pass", loaded.name, "is new");
    if (built == nullptr) return;
    c.that(built->name == loaded.name, "host pass", loaded.name, "stands where `" + std::string(built->name) + "` was");
    c.that(built->kind == loaded.kind, "host pass", loaded.name, "is another kind of pass");
    c.that(built->push_bytes == loaded.push_bytes && built->push_stages == loaded.push_stages && built->push_layout == loaded.push_layout,
           "host pass", loaded.name, "has other push constants");
  }
}

// The pass that copies the host's bytes of a slot.
std::string_view updating_pass(const Plan& plan, Index slot) {
  for (const Pass& pass : plan.passes)
    for (const Transfer& transfer : plan.transfers.subspan(pass.work.first_transfer, pass.work.transfer_count))
      if (transfer.kind == TransferKind::update && transfer.update_slot == slot) return pass.name;
  return {};
}

void compare_updates(Comparison& c) {
  for (const Transfer& transfer : c.loaded().transfers) {
    if (transfer.kind != TransferKind::update) continue;
    const std::string_view loaded = updating_pass(c.loaded(), transfer.update_slot), built = updating_pass(c.built(), transfer.update_slot);
    c.that(!built.empty(), "update", loaded, "is new");
    c.that(built == loaded, "update", loaded, "stands where that of `" + std::string(built) + "` was");
  }
}

void compare_conditions(Comparison& c) {
  const auto built = c.built().conditions, loaded = c.loaded().conditions;
  for (size_t i = 0; i < loaded.size(); ++i) {
    c.that(i < built.size(), "condition", loaded[i], "is new");
    if (i < built.size()) c.that(built[i] == loaded[i], "condition", loaded[i], "stands where `" + std::string(built[i]) + "` was");
  }
}

std::string_view pass_name(const Plan& plan, Index pass) { return pass == kNone ? std::string_view() : plan.passes[pass].name; }

}  // namespace

Status check_interface(const Plan& built, const Plan& loaded) {
  Comparison c(built, loaded);
  if (built.name != loaded.name)
    return Error{ErrorCode::invalid_argument,
                 "the plan is one of graph `" + std::string(loaded.name) + "`; this program runs `" + std::string(built.name) + "`"};
  c.rows(built.extents, loaded.extents, "extent", [](const Extent& a, const Extent& b) { return a.axes == b.axes; });
  if (built.extents.size() > loaded.extents.size()) c.that(false, "extent", built.extents[loaded.extents.size()].name, "is gone");
  compare_imports(c);
  c.rows(built.params, loaded.params, "parameter block", [](const Params& a, const Params& b) { return a.bytes == b.bytes && a.layout == b.layout; });
  for (size_t i = 0; i < loaded.params.size() && i < built.params.size(); ++i) {
    const std::string_view before = pass_name(built, built.params[i].pass), now = pass_name(loaded, loaded.params[i].pass);
    c.that(before == now || before.empty() || now.empty(), "parameter block", loaded.params[i].name, "belongs to another pass");
  }
  compare_updates(c);
  compare_conditions(c);
  c.rows(built.features, loaded.features, "feature", [](const Feature& a, const Feature& b) { return a.values == b.values; });
  for (size_t i = 0; i < loaded.features.size() && i < built.features.size(); ++i)
    c.that(built.features[i].layout == loaded.features[i].layout, "feature", loaded.features[i].name,
           "has values of other names, or in another order");
  c.rows(built.engine_sets, loaded.engine_sets, "engine set", [](const EngineSet& a, const EngineSet& b) { return a.role == b.role; });
  compare_callbacks(c);
  return c.status();
}

namespace {

template <class Row>
Index find_named(std::span<const Row> rows, std::string_view name) {
  for (Index i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return i;
  return kNone;
}

}  // namespace

Index find_pass(const Plan& plan, std::string_view name) { return find_named(plan.passes, name); }
Index find_resource(const Plan& plan, std::string_view name) { return find_named(plan.resources, name); }

}  // namespace rg
