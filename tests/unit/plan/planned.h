// Plans from .rg text, and their barriers as text, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/program.h"

namespace rg::compiler {

// The program of a graph whose body is `body`: module, an extent `view` of 64x64, a condition `sometimes` and a surface `backbuffer` stand around it.
dsl::Program program_of(const std::string& body);
dsl::Program program_of_text(const std::string& text);

FramePlan plan_of(const std::string& body, const PlanOptions& options = {});
FramePlan plan_of(const dsl::Program& program, const PlanOptions& options = {});

// One line a barrier, groups and passes between them; only barriers of `resource` unless it is empty.
//
//   --
//   hdr color_attachment_output/color_attachment_write -> fragment_shader/shader_sampled_read  color_attachment -> shader_read_only
//   [light]
std::string schedule_text(const PlanData& plan, const std::string& resource = {});

// Names of the live passes, in order, blanks between them and `|` for each non-empty group.
std::string order_text(const PlanData& plan);

const Pass& pass_named(const PlanData& plan, const std::string& name);
Index resource_named(const PlanData& plan, const std::string& name);
// The attachment of `pass` that is `resource`.
const Attachment& attachment_of(const PlanData& plan, const std::string& pass, const std::string& resource);

}  // namespace rg::compiler
