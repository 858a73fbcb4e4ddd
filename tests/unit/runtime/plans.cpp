#include "tests/unit/runtime/plans.h"

namespace rg::test {

Index add_shader_pass(TestPlan& p, std::string_view name, Ref source, Ref target, Index groups) {
  Pass pass;
  pass.name = name;
  pass.first_binding = static_cast<Index>(p.bindings.size()), pass.binding_count = 3;
  pass.first_params = static_cast<Index>(p.pass_params.size()), pass.params_count = 1;
  const Index params = TestPlan::add(p.params, Params{"step", 4, static_cast<Index>(p.passes.size())});
  p.pass_params.push_back(params);
  p.bindings.insert(p.bindings.end(), {buffer_binding(0, source), buffer_binding(1, target), params_binding(2, params)});
  const Index shader = TestPlan::add(p.shaders, ShaderModule{"add.comp", ShaderStage::compute, kAddShader});
  Pipeline pipeline;
  pipeline.name = name, pipeline.pass = static_cast<Index>(p.passes.size());
  pipeline.first_shader = TestPlan::add(p.pipeline_shaders, shader), pipeline.shader_count = 1;
  pass.pipeline = TestPlan::add(p.pipelines, pipeline);
  pass.work.kind = WorkKind::dispatch, pass.work.x = groups;
  return p.pass(pass, {touches(source, stage::compute_shader, access::shader_storage_read, Layout::undefined, false),
                       touches(target, stage::compute_shader, access::shader_storage_write, Layout::undefined, true)});
}

Counter counter() {
  Counter t;
  TestPlan& p = t.plan;
  const Index bytes = p.constant(64 * 4), one = p.constant(1);
  t.state = p.buffer("state", bytes, kStorageBuffer | kCopySrc | kCopyDst, Lifetime::history);
  p.resources[t.state].copies = 2, p.resources[t.state].init = InitKind::clear, p.resources[t.state].init_value = {{7, 0, 0, 0}};
  t.result = p.buffer("result", bytes, kCopyDst, Lifetime::readback);
  p.entry.push_back({{t.state, 0}, {}, stage::compute_shader | stage::copy, access::none, Layout::undefined, kNone, true});
  p.entry.push_back({{t.state, 1}, {}, stage::compute_shader, access::shader_storage_write});
  p.barriers({},
             {buffer_barrier({t.state, 1}, stage::compute_shader, access::shader_storage_write, stage::compute_shader, access::shader_storage_read),
              buffer_barrier({t.state, 0}, stage::compute_shader | stage::copy, access::shader_storage_write, stage::compute_shader,
                             access::shader_storage_write)});
  t.step = add_shader_pass(p, "step", {t.state, 1}, {t.state, 0}, one);
  p.barriers({}, {buffer_barrier({t.state, 0}, stage::compute_shader, access::shader_storage_write, stage::copy, access::transfer_read)});
  Transfer copy;
  copy.kind = TransferKind::copy_buffer, copy.src = {t.state, 0}, copy.dst = {t.result, 0};
  p.transfer("copy", {copy},
             {touches({t.state, 0}, stage::copy, access::transfer_read, Layout::undefined, false),
              touches({t.result, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  p.barriers({}, {to_host(t.result)});
  return t;
}

Index one_color_rendering(TestPlan& p, Index image, Index width, Index height, LoadOp load, ClearValue clear) {
  Attachment attachment;
  attachment.ref = {image, 0}, attachment.layout = Layout::color_attachment, attachment.load = load, attachment.clear = clear;
  Rendering rendering;
  rendering.first_color = TestPlan::add(p.attachments, attachment), rendering.color_count = 1;
  rendering.width = width, rendering.height = height;
  return TestPlan::add(p.renderings, rendering);
}

Tint tint() {
  Tint t;
  TestPlan& p = t.plan;
  p.extents.push_back({"view", 2, {8, 4, 1}, {64, 64, 1}});
  const Index width = p.extent_axis(0), height = p.extent_axis(1);
  const Index area = p.binary(ExprOp::mul, width, height), bytes = p.binary(ExprOp::mul, area, p.constant(4));
  t.scene = p.image("scene", kRgba8, width, height, kColorAttachment | kSampled);
  t.final = p.image("final", kRgba8, width, height, kColorAttachment | kCopySrc);
  t.result = p.buffer("result", bytes, kCopyDst, Lifetime::readback);
  constexpr auto output = stage::color_attachment_output;
  constexpr auto written = access::color_attachment_write;
  p.barriers({discard(t.scene, output, written, Layout::color_attachment, stage::fragment_shader)});
  Pass draw;
  draw.name = "draw", draw.module = "scene", draw.kind = PassKind::raster, draw.work.kind = WorkKind::host, draw.host_slot = 0;
  draw.rendering = one_color_rendering(p, t.scene, width, height, LoadOp::clear, {{0, 0x3f800000, 0x3f800000, 0x3f800000}});  // 0, 1, 1, 1
  t.draw = p.pass(draw, {touches({t.scene, 0}, output, written, Layout::color_attachment, true)});
  p.barriers(
      {transition(t.scene, output, written, Layout::color_attachment, stage::fragment_shader, access::shader_sampled_read, Layout::shader_read_only),
       discard(t.final, output, written, Layout::color_attachment, stage::copy)});
  Pass tint;
  tint.name = "tint", tint.module = "post", tint.kind = PassKind::raster, tint.work.kind = WorkKind::draw, tint.work.x = p.constant(3);
  tint.rendering = one_color_rendering(p, t.final, width, height, LoadOp::dont_care, {});
  Binding source;
  source.type = DescriptorType::combined_image_sampler, source.stages = kFragmentBit, source.ref = {t.scene, 0},
  source.layout = Layout::shader_read_only;
  source.range.aspects = aspect_color, source.sampler = TestPlan::add(p.samplers, Sampler{"nearest"});
  tint.first_binding = TestPlan::add(p.bindings, source), tint.binding_count = 1;
  const Index vertex = TestPlan::add(p.shaders, ShaderModule{"triangle.vert", ShaderStage::vertex, kTriangleShader});
  const Index fragment = TestPlan::add(p.shaders, ShaderModule{"tint.frag", ShaderStage::fragment, kTintShader});
  Pipeline pipeline;
  pipeline.name = "tint", pipeline.pass = 1, pipeline.shader_count = 2;
  pipeline.first_shader = TestPlan::add(p.pipeline_shaders, vertex);
  TestPlan::add(p.pipeline_shaders, fragment);
  tint.pipeline = TestPlan::add(p.pipelines, pipeline);
  t.tint = p.pass(tint, {touches({t.scene, 0}, stage::fragment_shader, access::shader_sampled_read, Layout::shader_read_only, false),
                         touches({t.final, 0}, output, written, Layout::color_attachment, true)});
  p.barriers({transition(t.final, output, written, Layout::color_attachment, stage::copy, access::transfer_read, Layout::transfer_src)});
  Transfer copy;
  copy.kind = TransferKind::copy_image_to_buffer, copy.src = {t.final, 0}, copy.dst = {t.result, 0};
  p.transfer("copy", {copy},
             {touches({t.final, 0}, stage::copy, access::transfer_read, Layout::transfer_src, false),
              touches({t.result, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  p.barriers({}, {to_host(t.result)});
  return t;
}

Relay relay() {
  constexpr Index graphics = 0, compute = 1, transfer = 2;
  Relay t;
  TestPlan& p = t.plan;
  p.queues = {{QueueKind::graphics}, {QueueKind::compute}, {QueueKind::transfer}};
  const Index bytes = p.constant(64 * 4), side = p.constant(8), one = p.constant(1);
  t.given = p.buffer("given", bytes, kStorageBuffer | kCopyDst);
  t.sum = p.buffer("sum", bytes, kStorageBuffer | kCopySrc);
  t.picture = p.image("picture", kR32f, side, side, kCopyDst | kCopySrc);
  t.result_sum = p.buffer("result_sum", bytes, kCopyDst, Lifetime::readback);
  t.result_picture = p.buffer("result_picture", bytes, kCopyDst, Lifetime::readback);
  p.resources[t.given].concurrent = p.resources[t.sum].concurrent = true;
  p.resources[t.given].no_alias = p.resources[t.sum].no_alias = p.resources[t.picture].no_alias = true;

  Transfer upload;
  upload.kind = TransferKind::update, upload.dst = {t.given, 0}, upload.update_slot = 0;
  p.transfer("upload", {upload}, {touches({t.given, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  p.end_batch(transfer, {{compute, 1, stage::copy, 1}}, stage::copy);

  add_shader_pass(p, "add", {t.given, 0}, {t.sum, 0}, one);
  p.barriers({discard(t.picture, stage::clear, access::transfer_write, Layout::transfer_dst, stage::clear)});
  Transfer clear;
  clear.kind = TransferKind::clear_color, clear.dst = {t.picture, 0}, clear.value = {{0x40400000, 0, 0, 0}};
  p.transfer("clear", {clear}, {touches({t.picture, 0}, stage::clear, access::transfer_write, Layout::transfer_dst, true)});
  ImageBarrier handed = transition(t.picture, stage::clear, access::transfer_write, Layout::transfer_dst, stage::clear, 0, Layout::transfer_src);
  handed.src_queue = compute, handed.dst_queue = graphics;
  p.barriers({handed});
  p.end_batch(compute, {{transfer, 1, stage::compute_shader}, {graphics, 1, stage::compute_shader | stage::clear, 1}}, stage::all_commands);

  handed.src_stages = stage::copy, handed.src_accesses = 0, handed.dst_stages = stage::copy, handed.dst_accesses = access::transfer_read;
  p.barriers({handed});
  Transfer copy_sum, copy_picture;
  copy_sum.kind = TransferKind::copy_buffer, copy_sum.src = {t.sum, 0}, copy_sum.dst = {t.result_sum, 0};
  copy_picture.kind = TransferKind::copy_image_to_buffer, copy_picture.src = {t.picture, 0}, copy_picture.dst = {t.result_picture, 0};
  p.transfer("copy", {copy_sum, copy_picture},
             {touches({t.sum, 0}, stage::copy, access::transfer_read, Layout::undefined, false),
              touches({t.picture, 0}, stage::copy, access::transfer_read, Layout::transfer_src, false),
              touches({t.result_sum, 0}, stage::copy, access::transfer_write, Layout::undefined, true),
              touches({t.result_picture, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  p.barriers({}, {to_host(t.result_sum), to_host(t.result_picture)});
  p.end_batch(graphics, {{compute, 1, stage::copy}}, stage::all_commands);
  return t;
}

Mips mips() {
  Mips t;
  TestPlan& p = t.plan;
  p.extents.push_back({"view", 2, {8, 8, 1}, {64, 64, 1}});
  t.image = p.image("chain", kR32f, p.extent_axis(0), p.extent_axis(1), kCopyDst | kCopySrc);
  p.resources[t.image].mips = 4;
  for (uint32_t mip = 0; mip < 4; ++mip) {
    ImageBarrier barrier = discard(t.image, stage::clear, access::transfer_write, Layout::transfer_dst, stage::clear);
    barrier.range.mip = mip, barrier.range.mips = 1, barrier.src_accesses = access::transfer_write;
    p.barriers({barrier});
    Transfer clear;
    clear.kind = TransferKind::clear_color, clear.dst = {t.image, 0}, clear.dst_range.mip = mip, clear.dst_range.mips = 1;
    clear.value.word[0] = std::bit_cast<uint32_t>(static_cast<float>(mip));
    static constexpr std::string_view kNames[] = {"clear[0]", "clear[1]", "clear[2]", "clear[3]"};
    Range range;
    range.mip = mip, range.mips = 1;
    const Index pass =
        p.transfer(kNames[mip], {clear}, {touches({t.image, 0}, stage::clear, access::transfer_write, Layout::transfer_dst, true, range)});
    p.passes[pass].first_mip_limit = TestPlan::add(p.mip_limits, MipLimit{t.image, mip});
    p.passes[pass].mip_limit_count = 1;
  }
  return t;
}

Aliased aliased() {
  Aliased t;
  TestPlan& p = t.plan;
  const Index side = p.constant(64), bytes = p.constant(64 * 64 * 4);
  t.a = p.image("a", kRgba8, side, side, kCopyDst | kCopySrc);
  t.b = p.image("b", kR32f, side, side, kCopyDst | kCopySrc);
  t.result_a = p.buffer("result_a", bytes, kCopyDst, Lifetime::readback);
  t.result_b = p.buffer("result_b", bytes, kCopyDst, Lifetime::readback);
  auto clear_and_read = [&](Index image, Index result, uint32_t word) {
    Transfer clear, copy;
    clear.kind = TransferKind::clear_color, clear.dst = {image, 0}, clear.value = {{word, word, word, word}};
    copy.kind = TransferKind::copy_image_to_buffer, copy.src = {image, 0}, copy.dst = {result, 0};
    const Index barrier = static_cast<Index>(p.image_barriers.size()), group = static_cast<Index>(p.groups.size());
    p.barriers({discard(image, stage::clear, access::transfer_write, Layout::transfer_dst, stage::copy)});
    p.acquires.push_back({image, group, barrier, 1, stage::clear, access::transfer_write, 0, group, static_cast<Index>(p.alias_clocks.size())});
    p.alias_clocks.insert(p.alias_clocks.end(), {group, 5});  // the batch ends at point 5
    p.releases.push_back({image, stage::copy, access::none, 0, group + 2});
    p.transfer("clear", {clear}, {touches({image, 0}, stage::clear, access::transfer_write, Layout::transfer_dst, true)});
    p.barriers(
        {transition(image, stage::clear, access::transfer_write, Layout::transfer_dst, stage::copy, access::transfer_read, Layout::transfer_src)});
    p.transfer("copy", {copy},
               {touches({image, 0}, stage::copy, access::transfer_read, Layout::transfer_src, false),
                touches({result, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  };
  clear_and_read(t.a, t.result_a, 0x3f800000);
  clear_and_read(t.b, t.result_b, 0x40000000);
  p.barriers({}, {to_host(t.result_a), to_host(t.result_b)});
  return t;
}

Split split() {
  Split t;
  TestPlan& p = t.plan;
  const Index bytes = p.constant(256);
  t.a = p.buffer("a", bytes, kCopyDst | kCopySrc), t.b = p.buffer("b", bytes, kCopyDst | kCopySrc);
  t.result_a = p.buffer("result_a", bytes, kCopyDst, Lifetime::readback), t.result_b = p.buffer("result_b", bytes, kCopyDst, Lifetime::readback);
  const auto fill = [&](std::string_view name, Index buffer, uint32_t word) {
    Transfer row;
    row.kind = TransferKind::fill, row.dst = {buffer, 0}, row.value.word[0] = word;
    p.transfer(name, {row}, {touches({buffer, 0}, stage::clear, access::transfer_write, Layout::undefined, true)});
  };
  const auto copy = [&](std::string_view name, Index from, Index to) {
    Transfer row;
    row.kind = TransferKind::copy_buffer, row.src = {from, 0}, row.dst = {to, 0};
    p.transfer(name, {row},
               {touches({from, 0}, stage::copy, access::transfer_read, Layout::undefined, false),
                touches({to, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  };
  const auto reused = [](Index buffer) { return buffer_barrier({buffer, 0}, stage::copy, access::none, stage::clear, access::transfer_write); };
  const auto filled = [](Index buffer) {
    return buffer_barrier({buffer, 0}, stage::clear, access::transfer_write, stage::copy, access::transfer_read);
  };
  p.barriers({}, {reused(t.a), reused(t.b)});
  fill("fill a", t.a, 5);
  p.barriers({}, {filled(t.a)});
  p.groups.back().event = 0, p.steps.back().kind = StepKind::set;
  fill("fill b", t.b, 6);
  p.steps.push_back({StepKind::barriers, kSplitGroup});
  copy("copy a", t.a, t.result_a);
  p.barriers({}, {filled(t.b)});
  copy("copy b", t.b, t.result_b);
  p.barriers({}, {to_host(t.result_a), to_host(t.result_b)});
  return t;
}

}  // namespace rg::test
