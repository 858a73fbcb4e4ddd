#!/usr/bin/env python3
"""Makes the random benchmark graphs G2(N): N passes and one present pass, the same graph for the same N everywhere.

usage: make_graph.py N [--seed S] [-o FILE.json]

The definition (random numbers by xorshift64, drawn in a fixed order) and the JSON schema are in bench/README.md. A fingerprint over all tables is
printed to stderr and checked where it is known, so that figures are comparable between machines and programs.
"""
import argparse
import json
import sys

MASK = (1 << 64) - 1
FINGERPRINTS = {10: "db32a8c3a01b0c54", 100: "b38b8415fcd5d133", 1000: "c78cf17f64c3d4ac", 10000: "a155d72786c7d3ca"}
FORMATS = ["rgba8", "rgba16f", "r32f", "d32", "rgb10a2", "rg16f", "r8", "r11g11b10f", "buffer"]
TEXEL_BYTES = dict(zip(FORMATS, [4, 8, 4, 4, 4, 4, 1, 4, 1]))
KINDS = ["image2d", "image3d", "buffer"]
USES = ["color_write", "color_rw", "depth_write", "depth_rw", "depth_read", "sampled_fs", "sampled_cs", "storage_write", "storage_rw"]
SIZES = [(1920, 1080), (960, 540), (480, 270)]


class Random:
    def __init__(self, seed):
        self.state = 0x2545F4914F6CDD1D ^ (seed * 0x9E3779B97F4A7C15 & MASK)

    def below(self, n):
        s = self.state
        s ^= (s << 13) & MASK
        s ^= s >> 7
        s ^= (s << 17) & MASK
        self.state = s
        return (s >> 33) % n


def image(index, name, fmt, size, imported=False):
    return {"id": index, "name": name, "kind": "image2d", "format": fmt, "width": size[0], "height": size[1], "depth": 1, "layers": 1, "mips": 1,
            "temporal_layers": 1, "imported": imported, "bytes": size[0] * size[1] * TEXEL_BYTES[fmt]}


def access(resource, use):
    return {"res": resource, "use": use, "base_layer": 0, "layers": 1, "history": 0}


def draw_reads(random, index, outputs, compute):
    reads = []
    for _ in range(1 + random.below(4)):
        distance = min(random.below(16), random.below(16))
        pick = random.below(2)
        if index == 0:
            continue
        producer = outputs[max(0, index - 1 - distance)]
        resource = producer[pick % len(producer)]
        if all(read["res"] != resource for read in reads):
            reads.append(access(resource, "sampled_cs" if compute else "sampled_fs"))
    return reads


def draw_writes(random, index, compute, resources):
    count, size = 1 + random.below(2), SIZES[random.below(3)]
    writes, has_depth = [], False
    for k in range(count):
        fmt = ["rgba8", "rgba16f", "r32f", "d32"][random.below(4)]
        if fmt == "d32" and (compute or has_depth):
            fmt = "r32f"
        has_depth = has_depth or fmt == "d32"
        use = "storage_write" if compute else "depth_write" if fmt == "d32" else "color_write"
        resources.append(image(len(resources), f"r{index}_{k}", fmt, size))
        writes.append(access(len(resources) - 1, use))
    return writes


def make_graph(n, seed):
    random = Random(seed)
    resources, passes, outputs = [image(0, "backbuffer", "rgba8", SIZES[0], imported=True)], [], []
    for index in range(n):
        kind, last = random.below(4), index == n - 1
        async_compute = not last and index % 20 == 19
        compute = not last and (async_compute or kind == 0)
        reads = draw_reads(random, index, outputs, compute)
        writes = draw_writes(random, index, compute, resources)
        outputs.append([write["res"] for write in writes])
        queue = "async_compute" if async_compute else "compute" if compute else "graphics"
        passes.append({"id": index, "name": f"p{index}", "queue": queue, "accesses": reads + writes})
    final = [access(outputs[-1][0], "sampled_fs"), access(0, "color_write")]
    passes.append({"id": n, "name": "present", "queue": "graphics", "accesses": final})
    return {"name": f"G2_{n}" + (f"_{seed}" if seed else ""), "resources": resources, "passes": passes}


def words_of(graph):
    yield len(graph["resources"])
    yield len(graph["passes"])
    for r in graph["resources"]:
        yield from (KINDS.index(r["kind"]), FORMATS.index(r["format"]), r["width"], r["height"], r["depth"], r["layers"], r["mips"], r["temporal_layers"],
                    int(r["imported"]))
    for p in graph["passes"]:
        yield from (int(p["queue"] != "graphics"), int(p["queue"] == "async_compute"), len(p["accesses"]))
        for a in p["accesses"]:
            yield from (a["res"], USES.index(a["use"]), a["base_layer"], a["layers"], a["history"])


def fingerprint(graph):
    """FNV-1a 64 over the tables as little-endian 64-bit words, from the offset 1469598103934665603 that the published figures use."""
    value = 1469598103934665603
    for word in words_of(graph):
        for byte in word.to_bytes(8, "little"):
            value = ((value ^ byte) * 0x100000001B3) & MASK
    return f"{value:016x}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("passes", type=int, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="other graphs of the same kind; default: 0, the published ones")
    parser.add_argument("-o", "--output", metavar="FILE.json", help="default: stdout")
    arguments = parser.parse_args()
    if arguments.passes < 1:
        parser.error("N must be at least 1")
    graph = make_graph(arguments.passes, arguments.seed)
    graph["fingerprint"] = fingerprint(graph)
    expected = FINGERPRINTS.get(arguments.passes, graph["fingerprint"]) if arguments.seed == 0 else graph["fingerprint"]
    if graph["fingerprint"] != expected:
        sys.exit(f"make_graph.py: fingerprint {graph['fingerprint']}, but G2({arguments.passes}) has {expected}")
    text = json.dumps(graph, indent=None) + "\n"
    if arguments.output:
        with open(arguments.output, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
