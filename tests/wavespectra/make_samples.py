"""Writes the small files in tests/spectra, which tests/spectra.rs reads: spectra in the formats of other programs.

usage: python tests/wavespectra/make_samples.py FOLDER

All files hold the same two spectra: at the second time the sea has twice the height. The waves come from 240 degrees,
with a spread that narrows towards the peak at 0.1 Hz. The numbers that the test expects are in spectra.json.
"""

import json
import sys
from pathlib import Path

import netCDF4
import numpy as np
import wavespectra  # noqa: F401 (adds the accessor .spec)
import xarray as xr

FREQUENCIES = np.array([0.06, 0.08, 0.1, 0.12, 0.15, 0.2])
FROM_DEG = np.arange(0, 360, 15.0)


def density():
    """E(time, frequency, direction), m2/Hz/degree."""
    shape = np.exp(-(((FREQUENCIES - 0.1) / 0.03) ** 2))[:, None]
    power = 4 + 20 * np.exp(-(((FREQUENCIES - 0.1) / 0.02) ** 2))[:, None]
    spread = (np.cos(np.radians(FROM_DEG - 240) / 2)[None, :] ** 2) ** power
    spread /= spread.sum(axis=1, keepdims=True) * 15
    one = 12.0 * shape * spread
    return np.stack([one, 4 * one])[:, None]


def sea():
    times = np.array(["2024-02-29T00:00", "2024-02-29T03:00"], dtype="datetime64[ns]")
    data = xr.DataArray(
        density(),
        dims=("time", "site", "freq", "dir"),
        coords={"time": times, "site": [1], "freq": FREQUENCIES, "dir": FROM_DEG},
        name="efth",
    ).to_dataset()
    data["lon"] = ("site", [4.5])
    data["lat"] = ("site", [52.5])
    wavespectra.core.attributes.set_spec_attributes(data)
    return data


def write_era5(path, file_format, numbered):
    """Packed logarithms as in ERA5, with the dimensions numbered or with their values."""
    with netCDF4.Dataset(path, "w", format=file_format) as file:
        sizes = {"longitude": 1, "latitude": 1, "directionNumber": 24, "frequencyNumber": 6, "time": 2}
        if not numbered:
            sizes = {{"directionNumber": "direction", "frequencyNumber": "frequency"}.get(k, k): n for k, n in sizes.items()}
        for name, size in sizes.items():
            file.createDimension(name, size)
        frequency, direction = list(sizes)[3], list(sizes)[2]
        time = file.createVariable("time", "i4", ("time",))
        time.units = "hours since 1900-01-01 00:00:00.0"
        time[:] = [1088376, 1088379]
        file.createVariable(frequency, "f8" if not numbered else "i4", (frequency,))[:] = (
            np.arange(1, 7) if numbered else FREQUENCIES
        )
        values = (FROM_DEG + 180) % 360
        file.createVariable(direction, "f8" if not numbered else "i4", (direction,))[:] = (
            np.arange(1, 25) if numbered else values
        )
        variable = file.createVariable(
            "d2fd", "i2", ("time", direction, frequency, "latitude", "longitude"), fill_value=-32767
        )
        variable.long_name = "2D wave spectra (single)"
        variable.units = "m**2 s radian**-1"
        logarithm = np.log10(np.maximum(density()[:, 0] * 180 / np.pi, 1e-12))
        low, high = logarithm.min(), logarithm.max()
        variable.scale_factor = (high - low) / 65000
        variable.add_offset = (high + low) / 2
        packed = np.transpose(logarithm, (0, 2, 1))[..., None, None]
        variable[:] = np.ma.masked_less(packed, -11)


def main(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    data = sea()
    data.spec.to_swan(folder / "swan.sp2")
    data.spec.to_ww3(folder / "ww3-netcdf4.nc")
    with xr.open_dataset(folder / "ww3-netcdf4.nc", decode_cf=False) as ww3:
        for name, kind in [("cdf1", "NETCDF3_CLASSIC"), ("cdf2", "NETCDF3_64BIT")]:
            ww3.load().to_netcdf(folder / f"ww3-{name}.nc", format=kind, unlimited_dims=["time"])
        with netCDF4.Dataset(folder / "ww3-cdf5.nc", "w", format="NETCDF3_64BIT_DATA") as out:
            for name, size in ww3.sizes.items():
                out.createDimension(name, None if name == "time" else size)
            for name, variable in ww3.variables.items():
                to = out.createVariable(name, variable.dtype, variable.dims)
                to[:] = variable.values
                to.setncatts({k: v for k, v in variable.attrs.items() if k != "_FillValue"})
    data.spec.to_netcdf(folder / "wavespectra.nc")
    write_era5(folder / "era5-numbered.nc", "NETCDF3_64BIT_OFFSET", True)
    write_era5(folder / "era5-values.nc", "NETCDF4", False)
    expected = {
        "hs_m": data.spec.hs().values[:, 0].tolist(),
        "mean_from_deg": data.spec.dm().values[:, 0].tolist(),
        "spread_deg": data.spec.dspr().values[:, 0].tolist(),
    }
    (folder / "spectra.json").write_text(json.dumps(expected, indent=1) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
