#!/usr/bin/env python3
"""mdr-tui beside what people use, on one machine in one run; prints the README's table.

    python3 benches/compare.py [--python python3.12]

Makes a virtual environment of its own in the system's temporary directory and installs NumPy, PyAbel and
openAbel there (openAbel 0.7 asks for Python 3.12 or later: give one with --python). Builds and runs
`cargo bench --bench rivals`. Times are lower deciles of many repetitions, the least of those of a few
rounds in which all take their turns: what the machine does when nothing else runs on it.
"""

import argparse
import json
import math
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ["numpy", "scipy", "PyAbel", "openabel"]


def typical_time(run, enough=0.2, fewest=5):
    run()
    begin, times = time.perf_counter(), []
    while time.perf_counter() - begin < enough or len(times) < fewest:
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return sorted(times)[len(times) // 10]


# --- the rivals: run inside the virtual environment -------------------------------------------------


def method_a_matrices(np, x):
    """Eqs. (1), (2) and (3) as the paper's Method A has them: piecewise linear data, exact integrals."""
    n = len(x)
    h = np.diff(x)
    with np.errstate(divide="ignore", invalid="ignore"):
        asin = np.arcsin(np.clip(np.where(x[:, None] > 0, x[None, :] / x[:, None], 0.0), 0.0, 1.0))
        acosh = np.arccosh(np.maximum(np.where(x[:, None] > 0, x[None, :] / x[:, None], 1.0), 1.0))
    root = np.sqrt(np.maximum(x[:, None] ** 2 - x[None, :] ** 2, 0.0))
    inner = np.tril(np.ones((n, n - 1)), -1)
    slope = (np.eye(n)[1:] - np.eye(n)[:-1]) / h[:, None]
    profile = (x[:, None] * np.diff(asin, axis=1) * inner) @ slope
    profile[:, 0] += 1.0
    arc, roots = np.diff(asin, axis=1) * inner, -np.diff(root, axis=1) * inner
    left = np.eye(n)[:-1]
    surface = 2 / np.pi * ((roots - arc * x[None, :-1]) @ slope + arc @ left)
    surface[0, 0] = 1.0
    steps = np.diff(acosh, axis=1)
    # On the axis: the first cell linear in x squared, logarithms behind it.
    steps[0] = [2.0, *np.log(x[2:] / x[1:-1])]
    stress = -1 / np.pi * (steps * np.triu(np.ones((n, n - 1)))) @ slope
    return profile, surface, stress


def literal_stress(np, x, q):
    """Eq. (3) on the fly, a row at a time, as one writes it in MATLAB or NumPy."""
    slope = np.diff(q) / np.diff(x)
    p = np.empty_like(q)
    for j in range(len(x)):
        if j == 0:
            step = np.concatenate([[2.0], np.diff(np.log(x[1:]))])
        else:
            step = np.diff(np.arccosh(x[j:] / x[j]))
        p[j] = -(slope[j:] @ step) / np.pi
    return p


def fig3(np, cells=100, cycles=200, steps=100):
    """The paper's Fig. 3: Method A by precomputed matrices, explicit Euler, buffers reused."""
    modulus, poisson, friction, wear = 2.3077e11, 0.3, 0.1, 1.3e-10
    tangential = modulus * 2 * (1 - poisson) / (2 - poisson)
    x = np.linspace(0.0, math.sqrt(2 * 0.01 * 1.1e-6), cells + 1)
    profile, surface, stress = method_a_matrices(np, x)
    stress = stress * tangential
    f, spring = x**2 / 0.02, np.zeros_like(x)
    g, limit, after, slip, tau, shear = (np.empty_like(x) for _ in range(6))
    ratio, shift = friction * modulus / tangential, 0.0
    for step in range(1, cycles * steps + 1):
        angle = 2 * math.pi * step / steps
        depth, new = 1e-6 + 1e-7 * math.sin(angle), 1e-7 * math.sin(angle + math.pi / 4)
        increment, shift = new - shift, new
        np.dot(profile, f, out=g)
        np.subtract(depth, g, out=limit)
        np.maximum(limit, 0.0, out=limit)
        limit *= ratio
        np.add(spring, increment, out=after)
        np.minimum(after, limit, out=after)
        np.negative(limit, out=limit)
        np.maximum(after, limit, out=after)
        np.subtract(spring, after, out=slip)
        slip += increment
        spring, after = after, spring
        np.dot(stress, spring, out=tau)
        np.dot(surface, slip, out=shear)
        tau *= shear
        np.maximum(tau, 0.0, out=tau)
        tau *= wear
        f += tau
    return f


def rivals():
    import numpy as np

    found = {"versions": {"python": platform.python_version(), "numpy": np.__version__}, "times": {}}
    times = found["times"]

    def put(name, n, seconds):
        times.setdefault(name, {})[str(n)] = seconds

    for n in [100, 300, 1000, 3000]:
        x = np.linspace(0.0, 1.0, n + 1)
        q = (1 - x**2) ** 3
        matrix = method_a_matrices(np, x)[2]
        out = np.empty_like(q)
        put("numpy matrix", n, typical_time(lambda: np.dot(matrix, q, out=out)))
        put("numpy literal", n, typical_time(lambda: literal_stress(np, x, q)))
    try:
        import openabel

        found["versions"]["openabel"] = openabel.__version__
        for n in [100, 300, 1000, 3000, 10_000, 30_000, 100_000]:
            x = np.linspace(0.0, 1.0, n + 1)
            q = (1 - x**2) ** 3
            plan = openabel.Abel(n + 1, 1, 0.0, 1.0 / n, method=3, order=2, eps=1e-8)
            put("openabel", n, typical_time(lambda: plan.execute(q)))
    except ImportError as error:
        found["versions"]["openabel"] = f"none ({error})"
    import abel

    found["versions"]["PyAbel"] = abel.__version__
    for n in [100, 300, 1000]:
        x = np.linspace(0.0, 1.0, n + 1)
        image = np.tile((1 - x**2) ** 3, (1, 1))
        for name, transform in [
            ("PyAbel three_point", abel.dasch.three_point_transform),
            ("PyAbel hansenlaw", abel.hansenlaw.hansenlaw_transform),
        ]:
            run = lambda: transform(image, direction="inverse", **quiet(name, n))
            put(name, n, typical_time(run))
    put("fig3 numpy", 100, typical_time(lambda: fig3(np), enough=0.0, fewest=3))
    print(json.dumps(found))


def quiet(name, n):
    # Its matrix is kept in memory between calls, and not on the disk.
    return {"basis_dir": None} if "three_point" in name else {}


# --- the comparison ---------------------------------------------------------------------------------


def environment(python):
    version = subprocess.run(
        [python, "-c", "import sys; print('%d%d' % sys.version_info[:2])"],
        check=True, capture_output=True, text=True,
    ).stdout.strip()
    home = Path(tempfile.gettempdir()) / f"mdr-tui-rivals-{version}"
    inside = home / "bin" / "python"
    if not inside.exists():
        subprocess.run([python, "-m", "venv", home], check=True)
        for package in PACKAGES:
            done = subprocess.run([inside, "-m", "pip", "install", "-q", package])
            if done.returncode != 0:
                print(f"{package} could not be installed", file=sys.stderr)
    return inside


def ours():
    done = subprocess.run(
        ["cargo", "bench", "--quiet", "--bench", "rivals"],
        cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True,
    )
    times = {}
    for line in done.stdout.splitlines():
        name, n, seconds = line.split(",")
        times.setdefault(name, {})[n] = float(seconds)
    return times


def least(times, more):
    """Keeps the lesser of two times for everything that was measured."""
    for name, row in more.items():
        kept = times.setdefault(name, {})
        for n, seconds in row.items():
            kept[n] = min(seconds, kept.get(n, seconds))


def shown(seconds):
    for unit, size in [("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)]:
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def growth(times, least):
    """The exponent of a fit through the logarithms."""
    points = [(math.log(int(n)), math.log(t)) for n, t in times.items() if int(n) >= least]
    if len(points) < 2:
        return ""
    mx, my = (sum(column) / len(points) for column in zip(*points))
    slope = sum((a - mx) * (b - my) for a, b in points) / sum((a - mx) ** 2 for a, _ in points)
    return f"N^{slope:.2f}"


def processor():
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def instructions():
    try:
        flags = Path("/proc/cpuinfo").read_text()
    except OSError:
        return ""
    return ", ".join(name for name in ["avx2", "fma", "avx512f"] if f" {name} " in flags)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--python", default=sys.executable, help="the interpreter for the rivals")
    arguments.add_argument("--rounds", type=int, default=3, help="how often all are measured (3)")
    arguments.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)
    chosen = arguments.parse_args()
    if chosen.inside:
        rivals()
        return
    inside = environment(chosen.python)
    single = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    times = {}
    for _ in range(chosen.rounds):
        least(times, ours())
        done = subprocess.run(
            [inside, __file__, "--inside"], check=True, stdout=subprocess.PIPE, text=True, env=single
        )
        found = json.loads(done.stdout)
        least(times, found["times"])
    versions = ", ".join(f"{name} {version}" for name, version in found["versions"].items())
    print(f"\n{processor()} ({instructions()}), one thread; {versions}; `python3 benches/compare.py`.\n")

    columns = ["100", "300", "1000", "3000", "10000", "100000"]
    base = times["fast uniform"]
    print("| Eq. (3), N cells | " + " | ".join(columns) + " | growth | times ours at 1000 |")
    print("|---|" + "---|" * (len(columns) + 2))
    for name in [
        "fast uniform", "fast graded", "dense uniform", "dense graded", "nalgebra", "literal",
        "numpy matrix", "numpy literal", "openabel", "PyAbel three_point", "PyAbel hansenlaw",
    ]:
        if name not in times:
            continue
        row = times[name]
        cells = [shown(row[n]) if n in row else "" for n in columns]
        ratio = f"{row['1000'] / base['1000']:.3g}" if "1000" in row else ""
        print(f"| {name} | " + " | ".join(cells) + f" | {growth(row, 1000)} | {ratio} |")
    steps = times["step"]
    print(f"\nA step of Fig. 3 with `product`: "
          + ", ".join(f"N = {n}: {shown(t)}" for n, t in steps.items())
          + f"; growth from 1000 on {growth(steps, 1000)}.\n")
    print("| Fig. 3, N = 100, 20 000 steps | time | times ours with `a` |")
    print("|---|---|---|")
    for name in ["fig3 a", "fig3 product", "fig3 numpy", "fig3 literal"]:
        seconds = times[name]["100"]
        print(f"| {name} | {shown(seconds)} | {seconds / times['fig3 a']['100']:.3g} |")


if __name__ == "__main__":
    main()
