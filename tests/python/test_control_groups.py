# SPDX-License-Identifier: BSD-3-Clause
"""Bounds of containers and clusters, pretended: files as the kernel writes them in each case.

Forms: cgroups(7), proc(5) and the kernel's "Control Group v2" and "Memory Resource Controller".
"""

import math
import os
from pathlib import Path

import pytest
from small_decks import write

from flexact.util import machine

MB = 2.0**20
V2 = "29 23 0:26 / /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw,nsdelegate\n"
DOCKER = "/docker/0a1b"


def system(root: Path, cgroup: str | None, mountinfo: str = "", **files: str) -> Path:
    """A root with what the kernel tells of the groups; of files `__` is / and `_` a dot."""
    if cgroup is not None:
        write(root / "proc/self/cgroup", cgroup)
    if mountinfo:
        write(root / "proc/self/mountinfo", mountinfo)
    for name, text in files.items():
        write(root / name.replace("__", "/").replace("DOT", "."), text)
    return root


def group(root: Path, folder: str, **files: object) -> None:
    for name, value in files.items():
        write(root / folder / name.replace("_", ".", 1), f"{value}\n")


def test_docker_with_a_namespace_of_its_own(tmp_path: Path) -> None:
    """As Docker and Kubernetes start containers today: the own group is the root."""
    root = system(tmp_path, "0::/\n", V2)
    group(root, "sys/fs/cgroup", memory_max=int(512 * MB), memory_current=int(200 * MB))
    assert machine.memory_left_of_group(root) == 312 * MB
    group(root, "sys/fs/cgroup", cpu_max="150000 100000")
    assert machine.processors_of_group(root) == 1.5


def test_docker_whose_groups_are_those_of_the_host(tmp_path: Path) -> None:
    """The path is the host's, and what is mounted begins at it."""
    mounts = (
        f"35 30 0:30 {DOCKER} /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n"
        f"36 30 0:31 {DOCKER} /sys/fs/cgroup/cpu,cpuacct ro - cgroup cgroup rw,cpu,cpuacct\n"
    )
    root = system(tmp_path, f"9:memory:{DOCKER}\n4:cpu,cpuacct:{DOCKER}\n", mounts)
    folder = root / "sys/fs/cgroup/memory"
    write(folder / "memory.limit_in_bytes", "1000\n")
    write(folder / "memory.usage_in_bytes", "400\n")
    assert machine.memory_left_of_group(root) == 600
    write(root / "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "50000\n")
    write(root / "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n")
    assert machine.processors_of_group(root) == 0.5
    write(root / "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n")
    assert machine.processors_of_group(root) == math.inf


def test_groups_round_it_that_cannot_be_seen(tmp_path: Path) -> None:
    """Version 1 tells of them in the statistics."""
    root = system(tmp_path, "7:memory:/\n")
    folder = root / "sys/fs/cgroup/memory"
    write(folder / "memory.limit_in_bytes", "9223372036854771712\n")
    write(folder / "memory.usage_in_bytes", "100\n")
    write(
        folder / "memory.stat", "cache 1\nhierarchical_memory_limit 700\ntotal_inactive_file 50\n"
    )
    assert machine.memory_left_of_group(root) == 650


def test_where_it_is_throttled_it_has_its_end(tmp_path: Path) -> None:
    root = system(tmp_path, "0::/user.slice/run.scope\n", V2)
    here = "sys/fs/cgroup/user.slice/run.scope"
    group(root, here, memory_max="max", memory_high=900, memory_current=100)
    assert machine.memory_left_of_group(root) == 800
    group(root, "sys/fs/cgroup/user.slice", memory_max=500, memory_current=200)
    assert machine.memory_left_of_group(root) == 300
    # Swap is no room for an analysis.
    group(root, here, memory_swap_max="max")
    assert machine.memory_left_of_group(root) == 300


def test_both_versions_side_by_side(tmp_path: Path) -> None:
    """The hybrid layout of systemd."""
    mounts = (
        "31 25 0:27 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n"
        "32 25 0:28 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n"
    )
    root = system(tmp_path, "5:memory:/job_7\n0::/job_7\n", mounts)
    write(root / "sys/fs/cgroup/memory/job_7/memory.limit_in_bytes", "2000\n")
    write(root / "sys/fs/cgroup/memory/job_7/memory.usage_in_bytes", "500\n")
    assert machine.memory_left_of_group(root) == 1500
    group(root, "sys/fs/cgroup/unified/job_7", cpu_max="max 100000")
    assert machine.processors_of_group(root) == math.inf


def test_mounted_elsewhere_under_a_name_with_a_blank(tmp_path: Path) -> None:
    root = system(tmp_path, "0::/\n", "30 20 0:20 / /my\\040groups rw - cgroup2 none rw\n")
    group(root, "my groups", memory_max=64, memory_current=4)
    assert machine.memory_left_of_group(root) == 60


@pytest.mark.parametrize("cgroup", [None, "0::/../../elsewhere\n", "nonsense\n"])
def test_a_sandbox_that_hides_its_path(tmp_path: Path, cgroup: str | None) -> None:
    root = system(tmp_path, cgroup)
    group(root, "sys/fs/cgroup", memory_max=1000)
    # How much is used is not told either.
    assert machine.memory_left_of_group(root) == 1000 or cgroup == "nonsense\n"


def test_nothing_is_bounded(tmp_path: Path) -> None:
    assert machine.memory_left_of_group(tmp_path) == math.inf
    assert machine.processors_of_group(tmp_path) == math.inf
    group(tmp_path, "sys/fs/cgroup", memory_max="nan", memory_current="x", cpu_max="1 2 3")
    assert machine.memory_left_of_group(tmp_path) == math.inf
    group(tmp_path, "sys/fs/cgroup", cpu_max="100000 0")
    assert machine.processors_of_group(tmp_path) == math.inf
    write(tmp_path / "sys/fs/cgroup/memory.max", "")
    assert machine.memory_left_of_group(tmp_path) == math.inf


def test_lxcfs_tells_the_container_in_place_of_the_machine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It writes a /proc/meminfo of the container's bound; the groups say the same or nothing."""
    root = system(tmp_path, "0::/.lxc\n", "", proc__meminfo="MemTotal: 4 kB\nMemAvailable: 3 kB\n")
    assert machine._of_machine(root) == 3 * 1024.0
    assert machine.memory_left_of_group(root) == math.inf


@pytest.mark.parametrize(
    ("quota", "of_machine", "expected"),
    [("150000 100000", 8, 2), ("300000 100000", 8, 3), ("10000 100000", 8, 1),
     ("max 100000", 8, 8), ("1600000 100000", 8, 8)],
)  # fmt: skip
def test_processors_of_a_container(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, quota: str, of_machine: int, expected: int
) -> None:
    monkeypatch.setattr(machine, "_given", lambda: of_machine)
    monkeypatch.setattr("sys.platform", "linux")
    group(system(tmp_path, "0::/\n"), "sys/fs/cgroup", cpu_max=quota)
    assert machine.processors(tmp_path) == expected


def test_processors_that_are_set(monkeypatch: pytest.MonkeyPatch) -> None:
    """From Python 3.13 on PYTHON_CPU_COUNT counts, and is asked for in another way."""
    monkeypatch.setattr(os, "process_cpu_count", lambda: 3, raising=False)
    assert machine._given() == 3
    monkeypatch.delattr(os, "process_cpu_count", raising=False)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 5}, raising=False)
    assert machine._given() == 2
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert machine._given() == 1
