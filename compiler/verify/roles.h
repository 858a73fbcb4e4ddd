// What each declared access of the program does to the GPU: the checker's own reading of the language.
#pragma once

#include <vector>

#include "compiler/verify/vulkan_model.h"
#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::verify {

// Ways a command touches memory: every supported combination of `stages` and `accesses` happens.
struct Touch {
  StageSet stages = 0;
  AccessSet accesses = 0;
  bool needed = true;  // false: may be named in a barrier, but the command is right without (a test after a clear)
};

// What a guard stands for is in the program of this configuration; features that it does not name have their first value.
bool is_selected(const dsl::Guard& guard, const std::vector<uint32_t>& configuration);
bool is_attachment(dsl::Role role);
// An attachment of a rendering, or the target of a resolve at its end.
bool is_rendered(const dsl::Pass& pass, dsl::Role role);
// Aspects an access means where it names none.
uint32_t default_aspects(dsl::Role role, uint32_t format_aspects);
// The access's range with the defaults of its role: attachments are one mip.
dsl::Range effective_range(const dsl::Access& access, uint32_t format_aspects);

// Of an access that is not an attachment. `planned` are the stages the plan states: an update of a buffer from host bytes may be a
// copy or an inline update, so there the plan chooses.
std::vector<Touch> touches_of(const dsl::Pass& pass, const dsl::Access& access, StageSet planned);
// Of an attachment with the operations the plan gives it.
std::vector<Touch> touches_of_attachment(const dsl::Access& access, LoadOp load, StoreOp store);
// The layouts in which `aspect` may be while the access happens.
bool is_legal_layout(const dsl::Pass& pass, const dsl::Access& access, uint32_t aspect, Layout layout);

// ---- contents ---------------------------------------------------------------------------------------------------

// The access depends on what was there before.
bool uses_contents(const dsl::Pass& pass, const dsl::Access& access);
bool writes_contents(const dsl::Access& access);
// Several writers in a row whose mutual order does not matter.
bool commutes(const dsl::Access& access);

}  // namespace rg::verify
