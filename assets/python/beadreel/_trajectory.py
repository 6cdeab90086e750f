# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads trajectories into xarray."""
from __future__ import annotations

import os
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import h5py
    import xarray

_OF_BEADS, _OF_CONTACTS = "particles/chain", "contacts"


def open_trajectory(path: str | os.PathLike[str]) -> xarray.Dataset | h5py.File:
    """A trajectory as an xarray.Dataset with the dimensions chain, time and bead (or contact), read when needed; without xarray as an
    h5py.File. Units and long names are attributes, as they are in the file. Shorter chains are filled up with NaN.
    """
    import h5py

    try:
        import xarray
    except ImportError:
        return h5py.File(path, "r")
    file = h5py.File(path, "r")  # stays open: values are read from it when they are needed
    chains = file["parameters/beadreel/chains"]
    data = xarray.Dataset(coords={"chain": [name.decode() for name in chains["name"][:]], "time": _column(file["time"], ("time",))},
                          attrs={key: _text(value) for key, value in file["parameters/beadreel"].attrs.items()})
    for group, axis, first, count in ((_OF_BEADS, "bead", "first_row", "beads"), (_OF_CONTACTS, "contact", "first_contact_row", "contacts")):
        if group in file:
            data = _with_group(data, file[group], axis, list(zip(chains[first][:].tolist(), chains[count][:].tolist())))
    data.set_close(file.close)
    return data


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value.item() if hasattr(value, "item") and getattr(value, "size", 0) == 1 else value


def _attributes(item: Any) -> dict[str, Any]:
    return {key: _text(item.attrs[key]) for key in ("units", "long_name") if key in item.attrs}


def _column(item: Any, dims: tuple[str, ...]) -> Any:
    return (dims, item[:], _attributes(item))


def _with_group(data: xarray.Dataset, group: Any, axis: str, rows: list[tuple[int, int]]) -> xarray.Dataset:
    """The fields and the constants of beads or contacts; `rows`: where each chain begins, and how many it has."""
    import h5py
    import numpy
    import xarray
    from xarray.core import indexing

    numbers = group[axis][:]
    least = min((int(numbers[first]) for first, count in rows if count), default=0)
    places = [(first, count, int(numbers[first]) - least if count else 0) for first, count in rows]  # in the file, and along the axis
    length = max((count + at for _, count, at in places), default=0)
    data = data.assign_coords({axis: (axis, least + numpy.arange(length))})
    for name, item in group.items():
        if isinstance(item, h5py.Dataset) and item.shape == numbers.shape and name not in ("chain", axis):
            kind = item.dtype if item.dtype.kind in "iuf" else numpy.dtype(float)
            values = numpy.full((len(rows), length), numpy.nan if kind.kind == "f" or any(count < length for _, count, _ in places) else 0,
                                float if any(count < length for _, count, _ in places) else kind)
            for chain, (first, count, at) in enumerate(places):
                values[chain, at : at + count] = item[first : first + count]
            data = data.assign_coords({name: (("chain", axis), values, _attributes(item))})
        elif isinstance(item, h5py.Group) and "value" in item:
            stored = item["value"]
            dims = ("chain", "time", axis, *("spatial",) * (stored.ndim - 2))
            lazy = indexing.LazilyIndexedArray(_of_chains(stored, places, length))
            data[name] = xarray.Variable(dims, lazy, _attributes(stored))
    return data


def _of_chains(stored: Any, places: list[tuple[int, int, int]], length: int) -> Any:
    """The field `stored`, (time, bead of all chains, ...), as an array (chain, time, bead, ...) that reads what is asked of it."""
    import numpy
    from xarray.backends import BackendArray
    from xarray.core import indexing

    class OfChains(BackendArray):
        shape = (len(places), stored.shape[0], length, *stored.shape[2:])
        dtype = stored.dtype
        lock = threading.Lock()

        def __getitem__(self, key: Any) -> Any:
            if isinstance(key, indexing.VectorizedIndexer):  # point by point
                return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self.read)
            return self.read(key.tuple)  # the adapter of xarray 2023 loses the first of slices that step backwards

        def read(self, key: tuple[Any, ...]) -> Any:
            chains, times, beads, *rest = (numpy.atleast_1d(numpy.arange(size)[part]) for size, part in zip(self.shape, key))
            values = numpy.full((len(chains), len(times), len(beads), *(len(part) for part in rest)), numpy.nan, self.dtype)
            for to, chain in enumerate(chains):
                first, count, at = places[chain]
                there = (beads >= at) & (beads < at + count)
                if len(times) and there.any():
                    rows = beads[there] - at + first
                    with self.lock:
                        block = stored[times.min() : times.max() + 1, rows.min() : rows.max() + 1]
                    block = block[times - times.min()][:, rows - rows.min()]
                    values[to][:, there] = block[(slice(None), slice(None), *rest)] if rest else block
            return numpy.asarray(values[tuple(0 if isinstance(part, (int, numpy.integer)) else slice(None) for part in key)])

    return OfChains()
