"""Where the cases of a study run: in threads of this process, or on a Dask cluster.

Each is a function of cases, materials, the number of workers and a function that is told how many cases are done, and
yields rows, in any order, as they come.
"""

from __future__ import annotations

import contextlib
import functools
import logging
import signal
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from multiprocessing import resource_tracker
from typing import Any

from .. import _native
from .._extras import require
from .cases import Case, Materials, Row, run_cases

Batches = Generator[list[tuple[Case, Row]], None, None]
Progress = Callable[[int], object]

# s: a batch takes long enough that handing it out costs little, and is short enough to lose when it is stopped.
BATCH = 1.5
# Of a cluster, whose workers hold no more than their share.
LARGEST_BATCH = 40
BATCHES_PER_WORKER = 20
SILENCE = logging.CRITICAL + 1  # a scheduler whose client is stopped while workers are busy calls that critical
PATIENCE = 60.0  # s, until a cluster has a worker


def in_threads(cases: Sequence[Case], materials: Materials, workers: int, progress: Progress) -> Batches:
    """In this process, on so many threads. As many cases at a time as take a second or two."""
    start, size = 0, 4 * workers
    while start < len(cases):
        began = time.monotonic()
        batch = cases[start : start + size]
        yield run_cases(batch, materials, workers, functools.partial(_further, progress, start))
        start += len(batch)
        faster = BATCH / max(time.monotonic() - began, 1e-3)
        size = int(min(max(4 * workers, size * faster), 4 * size))


def _further(progress: Progress, before: int, done: int) -> None:
    progress(before + done)


@contextlib.contextmanager
def without_interrupts() -> Iterator[None]:
    """Processes that begin in here leave Ctrl-C to this one, which ends them; it comes here when this is over."""
    if threading.current_thread() is not threading.main_thread():
        yield  # signals come to the main thread alone
        return
    came: list[bool] = []
    handler = signal.signal(signal.SIGINT, lambda *_: came.append(True))
    blocks = hasattr(signal, "pthread_sigmask")
    if blocks:
        # Starting this one of multiprocessing's own would unblock what is blocked.
        resource_tracker.ensure_running()
        # For the processes, which inherit it; in this one another thread may take the signal, so there is a handler, too.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if blocks:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        signal.signal(signal.SIGINT, handler)
    if came:
        raise KeyboardInterrupt


def on_cluster(
    address: str, cases: Sequence[Case], materials: Materials, workers: int, progress: Progress
) -> Batches:
    """On a Dask cluster by its address; `local` is a small one on this machine, of so many workers."""
    distributed = require("distributed", extra="study")
    with contextlib.ExitStack() as held:
        with without_interrupts():
            if address == "local":
                of_cluster = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": ":0"}
                address = held.enter_context(distributed.LocalCluster(**of_cluster, silence_logs=SILENCE))
            client = held.enter_context(distributed.Client(address))
        greet(client)
        yield from through(client, cases, materials, progress)


def version() -> str:
    """Of the engine, on the machine that is asked."""
    return _native.__version__


def greet(client: Any) -> None:
    """Waits for a worker and sees that all of them have this version of the package."""
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
        versions: dict[str, Any] = client.run(version)
    except TimeoutError:
        raise OSError(f"the cluster has had no worker for {PATIENCE:g} s") from None
    except ModuleNotFoundError as missing:
        raise OSError(f"a worker of the cluster has no module {missing.name}: install the same wheel there") from None
    others = {worker: other for worker, other in versions.items() if other != version()}
    if others:
        said = ", ".join(f"{worker} has {other}" for worker, other in others.items())
        raise OSError(f"expected version {version()} of pounding-fmu on all workers, but {said}")


def through(client: Any, cases: Sequence[Case], materials: Materials, progress: Progress) -> Batches:
    """The rows of all cases by way of a client of a cluster. The materials are sent once to each worker."""
    distributed = require("distributed", extra="study")
    [everything] = client.scatter([materials], broadcast=True, hash=False)
    threads = max(1, sum(client.nthreads().values()))
    size = min(LARGEST_BATCH, max(1, len(cases) // (BATCHES_PER_WORKER * threads)))
    batches = [cases[start : start + size] for start in range(0, len(cases), size)]
    # Not pure: the cluster shall not look whether it has run such a batch before.
    submitted = [client.submit(run_cases, batch, everything, 1, pure=False) for batch in batches]
    done = 0
    for future, rows in distributed.as_completed(submitted, with_results=True):
        yield rows
        done += len(rows)
        progress(done)
        future.release()
