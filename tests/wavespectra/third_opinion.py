"""Compares Seastate with the Python package wavespectra, in both directions. scripts/test.sh runs it as an optional step.

usage: python tests/wavespectra/third_opinion.py PROGRAM

1. `seastate export --spectrum-to` writes seas as SWAN and NetCDF files. wavespectra reads them, and its height, peak
   period, mean direction and spread are compared with the theory of `seastate stats --json`.
2. The samples in tests/spectra, which wavespectra wrote (make_samples.py), are read by `seastate stats --spectrum`, and
   compared with what wavespectra says about them (spectra.json).
"""

import json
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np

warnings.filterwarnings("ignore")
from wavespectra import read_swan, read_ww3  # noqa: E402

STATES = [
    "wind=12&fetch=200&n=64&cascades=2",
    "wind=8&fetch=60&dir=20&spread=hasselmann&n=64&cascades=2",
    "spectrum=tma&wind=15&depth=15&spread=mitsuyasu&dir=100&n=64&cascades=2",
    "wind=7&fetch=30&scale2=1&hs2=1.5&tp2=13&dir2=300&n=64&cascades=2",
]
SAMPLES = ["swan.sp2", "ww3-cdf1.nc", "ww3-cdf5.nc", "ww3-netcdf4.nc", "wavespectra.nc", "era5-values.nc"]
# wavespectra sums over bands and refines the peak by a parabola; Seastate integrates the formula.
LIMITS = {"hs_m": 0.005, "tp_s": 0.02, "mean_from_deg": 0.2, "spread_deg": 0.3}


def stats(program, *args):
    out = subprocess.run([program, "stats", "--json", *args], capture_output=True, text=True, check=True)
    return json.loads(out.stdout)["theory"]


def differences(ours, theirs):
    """Relative differences of height and period, absolute ones of angles in degrees."""
    out = {}
    for key, value in theirs.items():
        if key.endswith("_deg"):
            out[key] = abs((ours[key] - value + 180) % 360 - 180)
        else:
            out[key] = abs(ours[key] / value - 1)
    return out


def report(name, ours, theirs, limits):
    found = differences(ours, theirs)
    wrong = [key for key, value in found.items() if not value <= limits[key]]
    numbers = "  ".join(f"{key} {ours[key]:.3f}/{theirs[key]:.3f}" for key in theirs)
    print(f"{'WRONG' if wrong else 'ok':<6}{name:<70} {numbers}", flush=True)
    return not wrong


def numbers_of(dataset):
    spec = dataset.spec
    one = lambda values: float(np.asarray(values).ravel()[0])  # noqa: E731
    return {
        "hs_m": one(spec.hs(tail=False)),
        "tp_s": one(spec.tp(smooth=True)),
        "mean_from_deg": one(spec.dm()),
        "spread_deg": one(spec.dspr()),
    }


def main(program):
    root = Path(__file__).resolve().parent.parent
    right = True
    with tempfile.TemporaryDirectory() as folder:
        for i, state in enumerate(STATES):
            ours = stats(program, state)
            for ending, reader in [("sp2", read_swan), ("nc", read_ww3)]:
                path = Path(folder) / f"{i}.{ending}"
                subprocess.run([program, "export", state, "--spectrum-to", path], check=True, capture_output=True)
                right &= report(f"{ending} {state}", ours, numbers_of(reader(str(path))), LIMITS)
    expected = json.loads((root / "spectra" / "spectra.json").read_text())
    for name in SAMPLES:
        for index in [0, 1]:
            theirs = {key: values[index] for key, values in expected.items()}
            args = ["n=64&cascades=2&spectrum=measured", "--spectrum", root / "spectra" / name, "--spectrum-index", str(index)]
            ours = stats(program, *args)
            # Straight lines between directions 15 degrees apart widen the spread a little.
            limits = LIMITS | {"spread_deg": 1.0}
            right &= report(f"{name} {index}", ours, theirs, limits)
    print("wavespectra agrees" if right else "wavespectra DISAGREES")
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
