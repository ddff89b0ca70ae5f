#!/usr/bin/env python3
"""Draws the curves of bench_spatial as SVG: time per element or query over the number of elements, one line per peer.

usage: plot.py FOLDER spatial.json [more.json]

Writes FOLDER/OPERATION_SCALAR.svg for each operation that was measured with two numbers of elements or more. A point is the
median over repetitions, for uniform data.
"""
import json
import math
import pathlib
import statistics
import sys

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 360, 62, 150, 34, 44
COLOURS = {"bbtt": "#d62728", "pcd": "#d62728"}
OTHERS = ["#1f77b4", "#2ca02c", "#9467bd", "#8c564b", "#17becf", "#7f7f7f"]


def per_item(operation, count):
    """How many elements or queries an iteration handles; None if that depends on the data."""
    if operation.startswith("nearest"):
        return 1000
    if operation.startswith("query"):
        return None if operation.endswith("%") else 2000
    if operation == "erase":
        return count / 2
    return count / 100 if operation == "move_1%" else count


def read(paths):
    times = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for run in json.load(file)["benchmarks"]:
                if run.get("run_type") == "aggregate":
                    continue
                operation, data, scalar, count, peer = run["run_name"].split("/")[:5]
                items = per_item(operation, int(count))
                if items and data == "uniform":
                    key = (operation, scalar), peer, int(count)
                    times.setdefault(key, []).append(run["cpu_time"] * 1e6 / items)  # ms to ns
    charts = {}
    for (chart, peer, count), values in sorted(times.items()):
        charts.setdefault(chart, {}).setdefault(peer, []).append((count, statistics.median(values)))
    return charts


def svg(title, lines):
    points = [p for line in lines.values() for p in line]
    x0, x1 = (math.log10(f(c for c, _ in points)) for f in (min, max))
    y0, y1 = math.log10(min(t for _, t in points)), math.log10(max(t for _, t in points))
    y0, y1 = y0 - 0.1, y1 + 0.1

    def x(count):
        return LEFT + (math.log10(count) - x0) / (x1 - x0) * (WIDTH - LEFT - RIGHT)

    def y(time):
        return HEIGHT - BOTTOM - (math.log10(time) - y0) / (y1 - y0) * (HEIGHT - TOP - BOTTOM)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           f'font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="20" font-size="14">{title}</text>',
           f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">elements</text>']
    for power in range(math.ceil(x0 - 1e-9), math.floor(x1 + 1e-9) + 1):
        at = x(10 ** power)
        out.append(f'<path d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        out.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">'
                   f'10<tspan dy="-5" font-size="9">{power}</tspan></text>')
    for power in range(math.floor(y0), math.ceil(y1) + 1):
        for digit in (1, 2, 5):
            time = digit * 10.0 ** power
            if y0 <= math.log10(time) <= y1:
                label = f"{time:g} ns" if time < 1e3 else f"{time / 1e3:g} µs" if time < 1e6 else f"{time / 1e6:g} ms"
                out.append(f'<path d="M{LEFT} {y(time):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
                out.append(f'<text x="{LEFT - 5}" y="{y(time) + 4:.1f}" text-anchor="end">{label}</text>')
    others = iter(OTHERS * 3)
    ends = sorted(((y(line[-1][1]), peer) for peer, line in lines.items()))
    label_at, below = {}, -math.inf
    for at, peer in ends:  # labels that do not overlap
        below = label_at[peer] = max(at, below + 14)
    for peer in sorted(lines):
        colour = COLOURS.get(peer) or next(others)
        path = "L".join(f"{x(c):.1f} {y(t):.1f}" for c, t in lines[peer])
        out.append(f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out += [f'<circle cx="{x(c):.1f}" cy="{y(t):.1f}" r="3" fill="{colour}"/>' for c, t in lines[peer]]
        out.append(f'<text x="{WIDTH - RIGHT + 8}" y="{label_at[peer] + 4:.1f}" fill="{colour}">{peer}</text>')
    return "\n".join(out + ["</svg>", ""])


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for (operation, scalar), chart in sorted(read(sys.argv[2:]).items()):
        lines = {peer: line for peer, line in chart.items() if len(line) > 1}
        if lines:
            name = f"{operation}_{scalar}".replace("%", "percent")
            title = f"{operation}, {scalar}: time per {'query' if operation.startswith(('query', 'near')) else 'element'}"
            (folder / f"{name}.svg").write_text(svg(title, lines), encoding="utf-8")


main()
