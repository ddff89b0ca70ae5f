#!/usr/bin/env python3
"""Prints one Markdown table of ratios from the JSON of bench_spatial.

usage: bench_spatial --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true \
           --benchmark_out=spatial.json && compare.py spatial.json [more.json] [--native native.json [more.json]]

Each cell is the geometric mean over the data sets of (median of the peer / median of ours), above 1 where ours is faster,
and in brackets the worst data set. The peer is the fastest of the variants named. What follows --native was measured by a
program compiled with -march=native and gets columns of its own. Peers that did not come to the same answers are not compared:
they are named, and the exit code is 1.
"""
import json
import math
import statistics
import sys

INCREMENTAL = ["boost_linear", "boost_quadratic", "boost_rstar"]
LINES = [  # operation, ours, peers, wanted
    ("insert", "bbtt", INCREMENTAL, 3),
    *[(f"query_{k}", "bbtt", INCREMENTAL, 2) for k in ("1", "10", "100", "1%")],
    ("load", "bbtt", ["boost_packed"], 1.5),
    *[(f"query_loaded_{k}", "bbtt", ["boost_packed"], 2) for k in ("1", "10", "100", "1%")],
    ("erase", "bbtt", INCREMENTAL, 3),
    ("move_1%", "bbtt", INCREMENTAL, 3),
    ("move_100%", "bbtt", INCREMENTAL, 3),
    *[(f"nearest_{k}", "bbtt", ["boost_packed"], 1.5) for k in ("1", "10", "100")],
    *[(f"nearest_point_{k}", "bbtt", ["nanoflann"], 1.5) for k in ("1", "10", "100")],
    ("pairs", "bbtt", ["boost_packed"], 10),
    ("pairs", "bbtt_with_build", ["cgal_box_intersection"], 1.5),
    ("merge", "pcd", ["boost_rtree"], 5),
    ("merge", "pcd", ["unordered_map"], 2),
    ("merge", "pcd", ["vtk_octree"], ""),
    ("within", "pcd", ["nanoflann"], 3),
    *[(name, "bbtt", ["box2d"], "") for name in ("insert", "query_1", "query_10", "query_100", "query_1%", "erase",
                                                 "move_1%", "move_100%")],
    *[(name, "bbtt", ["libspatialindex"], "") for name in ("insert", "query_10", "load", "query_loaded_10",
                                                           "nearest_10", "erase", "move_100%")],
]


def close(a, b):
    """Sums of numbers of elements; a distance that is rounded otherwise may change one of very many."""
    return abs(a - b) <= 1e-5 * max(abs(a), abs(b))


def differing(paths):
    answers = {}
    for path in paths:
        if path == "--native":
            continue
        with open(path, encoding="utf-8") as file:
            for run in json.load(file)["benchmarks"]:
                *what, peer = run["run_name"].split("/")[:5]
                if "answer" in run and run.get("run_type") != "aggregate":
                    answers.setdefault(tuple(what), {})["/".join([*what, peer])] = run["answer"]
    return [by_peer for by_peer in answers.values() if not close(min(by_peer.values()), max(by_peer.values()))]


def read(paths):
    times, memory = {}, {}
    build = ""
    for path in paths:
        if path == "--native":
            build = " native"
            continue
        with open(path, encoding="utf-8") as file:
            for run in json.load(file)["benchmarks"]:
                if run.get("run_type") == "aggregate":
                    continue
                operation, data, scalar, count, peer = run["run_name"].split("/")[:5]
                scalar += build
                times.setdefault((operation, scalar, int(count)), {}).setdefault(data, {}).setdefault(peer, []).append(
                    run["cpu_time"])
                if "bytes_per_element" in run:
                    memory.setdefault((scalar, int(count)), {}).setdefault(data, {})[operation, peer] = (
                        run["bytes_per_element"])
    return times, memory


def ratio(by_data, ours, peers):
    ratios = {}
    for data, by_peer in by_data.items():
        others = [statistics.median(by_peer[p]) for p in peers if p in by_peer]
        if ours in by_peer and others:
            ratios[data] = min(others) / statistics.median(by_peer[ours])
    if not ratios:
        return "", None
    mean = math.exp(statistics.fmean(map(math.log, ratios.values())))
    worst = min(ratios, key=ratios.get)
    return f"{mean:.2f} ({ratios[worst]:.2f} {worst})" if len(ratios) > 1 else f"{mean:.2f}", mean


def main():
    wrong = differing(sys.argv[1:])
    if wrong:
        sys.exit("\n".join(["these do not have the same answers:", *map(str, wrong)]))
    times, memory = read(sys.argv[1:])
    columns = sorted({key[1:] for key in times})
    print("| operation | against | wanted | " + " | ".join(f"{s}, {n:,}" for s, n in columns) + " |")
    print("|---" * (3 + len(columns)) + "|")
    for operation, ours, peers, wanted in LINES:
        cells = [ratio(times.get((operation, *column), {}), ours, peers)[0] for column in columns]
        if any(cells):
            against = "fastest Boost" if peers is INCREMENTAL else peers[0]
            name = operation + (" (" + ours + ")" if ours not in ("bbtt", "pcd") else "")
            print(f"| {name} | {against} | {wanted} | " + " | ".join(cells) + " |")
    if memory:
        cells = []
        for column in columns:
            by_data = memory.get(column, {})
            pairs = [(d[("load", "bbtt")], d[("load", "boost_packed")]) for d in by_data.values()
                     if ("load", "bbtt") in d and ("load", "boost_packed") in d]
            cells.append(f"{statistics.fmean(a for a, _ in pairs):.0f} / {statistics.fmean(b for _, b in pairs):.0f}"
                         if pairs else "")
        print("| bytes per element, loaded | boost_packed | ≤ 1× | " + " | ".join(cells) + " |")


main()
