#!/usr/bin/env python3
"""Turns a benchmark graph in JSON (schema: bench/README.md) into an .rg file whose passes the host records.

usage: graph_to_rg.py GRAPH.json [-o FILE.rg] [--keep]

With --keep no pass is ever culled, as in systems that run every pass they are given.
"""
import argparse
import json
import sys

FORMATS = {"rgba8": "rgba8", "rgba16f": "rgba16f", "r32f": "r32f", "d32": "d32f", "rgb10a2": "rgb10a2", "rg16f": "rg16f", "r8": "r8", "r11g11b10f": "r11g11b10f"}


def declaration(resource):
    name = resource["name"]
    if resource["kind"] == "buffer":
        return f"  buffer {name} : u32[{resource['width'] // 4}]"
    size = f"{resource['width']}x{resource['height']}"
    if resource["kind"] == "image3d":
        size = f"{size}x{resource['depth']} 3d"
    text = f"  image {name} : {FORMATS[resource['format']]} {size}"
    if resource["mips"] > 1:
        text += f" mips {resource['mips']}"
    if resource["layers"] > 1:
        text += f" layers {resource['layers']}"
    if resource["temporal_layers"] > 1:
        text += f" history {resource['temporal_layers'] - 1} init clear 0"
    return text


def target(resource, access):
    text = resource["name"]
    if access["history"]:
        text += f".prev({access['history']})"
    if resource["layers"] > 1 and access["layers"] < resource["layers"]:
        text += f".layer({access['base_layer']})" if access["layers"] == 1 else f".layers({access['base_layer']}, {access['layers']})"
    if resource["mips"] > 1:
        text += ".mip(0)"
    return text


def statement(resource, access):
    use, what = access["use"], target(resource, access)
    stage = "fragment" if use.endswith("_fs") else "compute"
    if use.startswith("sampled"):
        role = "storage" if resource["kind"] == "buffer" else "sampled"
        return f"read {what} as {role} in {stage}"
    return {
        "color_write": f"color {what} covers",
        "color_rw": f"color {what}",
        "depth_write": f"depth {what} clear 0.0",
        "depth_rw": f"depth {what}",
        "depth_read": f"depth {what} readonly",
        "storage_write": f"write {what} as storage in compute",
        "storage_rw": f"update {what} as storage in compute",
    }[use]


def pass_text(graph, row, keep):
    kind = "raster" if row["queue"] == "graphics" else "compute"
    queue = " queue compute may" if row["queue"] == "async_compute" else ""
    lines = [f"  pass {row['name']} : {kind}{queue} {{"]
    lines += [f"    {statement(graph['resources'][access['res']], access)}" for access in row["accesses"]]
    lines += ["    keep"] if keep else []
    return lines + ["  }"]


def convert(graph, keep):
    imported = [resource for resource in graph["resources"] if resource["imported"]]
    parameters = ", ".join(f"surface {r['name']}: {FORMATS[r['format']]} {r['width']}x{r['height']}" for r in imported)
    lines = [f"// Benchmark graph {graph['name']}, fingerprint {graph['fingerprint']}, made by tools/graph_to_rg.py. The host records every pass.",
             f"module {graph['name'].lower()}", "", f"graph frame({parameters})", "{"]
    lines += [declaration(resource) for resource in graph["resources"] if not resource["imported"]]
    for row in graph["passes"]:
        lines += [""] + pass_text(graph, row, keep)
    return "\n".join(lines + ["}"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("graph", metavar="GRAPH.json", help="- reads stdin")
    parser.add_argument("-o", "--output", metavar="FILE.rg", help="default: stdout")
    parser.add_argument("--keep", action="store_true", help="no pass is culled")
    arguments = parser.parse_args()
    with sys.stdin if arguments.graph == "-" else open(arguments.graph, encoding="utf-8") as file:
        text = convert(json.load(file), arguments.keep)
    if arguments.output:
        with open(arguments.output, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
