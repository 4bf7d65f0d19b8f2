#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A raster that is larger than the memory of any worker becomes six faces, on a cluster of Dask, and one worker is killed on
the way. The raster is made up where it is read, so that the result can be judged: pixel by pixel against the formula.

usage: raster_on_a_cluster.py [--megabytes N] [--workers N] [--keep-all]

--megabytes   of the raster, float32; 200 without it, 20000 is the long run
--workers     processes, each with 1 GB at most and one thread
--keep-all    kill no worker
"""

import argparse
import math
import os
import signal
import threading

import dask
import dask.array as da
import numpy as np

import cubemap
from cubemap import large

BLOCK = 1024


def field(lon, lat):
    """What the raster shows: smooth, and different everywhere."""
    return (np.sin(3 * lon) * np.cos(lat) ** 3 + 0.5 * np.sin(2 * lat)).astype(np.float32)


def block_of(height, block_info=None):
    """A block of the raster, by where it is."""
    rows, columns = (np.arange(*ends) + 0.5 for ends in block_info[None]["array-location"])
    return field((columns * np.pi / height - np.pi)[np.newaxis, :], (np.pi / 2 - rows * np.pi / height)[:, np.newaxis])


def judged(tile, edge, block_info=None):
    """Of a tile of the result the greatest error, and how many pixels it has."""
    (face, _), rows, columns = (np.array(ends) for ends in block_info[0]["array-location"])
    surface = cubemap.Surface(f"cube:coupled;size={edge}")
    x, y, z = surface.directions(np.uint8(face), np.arange(*columns)[np.newaxis, :] + 0.5, np.arange(*rows)[:, np.newaxis] + 0.5)
    error = np.abs(tile[0] - field(*cubemap.lonlat_from_direction(x, y, z)))
    return np.array([error.max(), error.size], np.float64).reshape(1, 1, 1, 2)


def most_memory():
    """The most bytes that this process has had. Not getrusage's: Linux gives a new process what its parent had, and a worker's
    parent has the graph."""
    with open("/proc/self/status", encoding="ascii") as lines:
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM:")) * 1024


def tiles_done(dask_scheduler):
    """How many tiles are judged. Of all tasks most come first: those that make the raster up and cut it."""
    prefix = dask_scheduler.task_prefixes.get("judged")
    return prefix.state_counts["memory"] if prefix else 0


def kill_one(client, killed):
    """End a worker's process as if its machine had failed, when so many tiles are done."""
    def work():
        while not killed["ready"].wait(0.05):
            done = client.run_on_scheduler(tiles_done)
            if done >= killed["after"]:
                pid = next(iter(client.run(os.getpid).values()))
                os.kill(pid, signal.SIGKILL)
                killed.update(pid=pid, done=done)
                return

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    return thread


def run(megabytes, workers, kills=True):
    """The greatest error, the pixels of the result and how many it should have, the pid of the worker that was killed and the
    part of the tiles that was done then, and the most memory of a worker."""
    from dask.distributed import Client, LocalCluster

    # 4 bytes of 2 height^2 pixels, in whole blocks
    height = BLOCK * max(2, round(math.sqrt(megabytes * 1e6 / 8) / BLOCK))
    raster = da.map_blocks(block_of, height, chunks=((BLOCK,) * (height // BLOCK), (BLOCK,) * (2 * height // BLOCK)), dtype=np.float32)
    edge = height // 2  # as many pixels along the equator as the raster has
    faces = large.reproject(raster, "cube:coupled", edge, tile=BLOCK, filter="bilinear")
    errors = faces.map_blocks(judged, edge, new_axis=3, chunks=(*((1,) * count for count in faces.numblocks), (2,)), dtype=np.float64)
    found = da.stack([errors[..., 0].max(), errors[..., 1].sum()])
    dask.config.set({"distributed.scheduler.allowed-failures": 10})
    with LocalCluster(n_workers=workers, threads_per_worker=1, memory_limit="1GB", dashboard_address=None) as cluster, \
            Client(cluster) as client:
        killed = {"ready": threading.Event(), "after": (faces.npartitions + 1) // 2}
        thread = kill_one(client, killed) if kills else None
        worst, count = client.compute(found).result()
        killed["ready"].set()
        if thread:
            thread.join()
        peak = max(client.run(most_memory).values())
    print(f"{raster.nbytes / 1e6:.0f} MB in {raster.npartitions} blocks to 6 x {edge} x {edge}: worst error {worst:.2e}, "
          f"worker killed: {killed.get('pid', 'none')} after {killed.get('done', 0)} of {faces.npartitions} tiles, "
          f"most memory of a worker {peak / 1e6:.0f} MB")
    return worst, int(count), 6 * edge * edge, killed.get("pid"), killed.get("done", 0) / faces.npartitions, peak


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--megabytes", type=float, default=200)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--keep-all", action="store_true")
    given = parser.parse_args()
    worst, count, expected, pid, _, peak = run(given.megabytes, given.workers, not given.keep_all)
    # linear interpolation of the field is off by less than a step squared
    if count != expected or worst > 4e-5 or peak > 1e9 or (pid is None) != given.keep_all:
        raise SystemExit("not as it should be")


if __name__ == "__main__":
    main()
