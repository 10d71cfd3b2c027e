"""A process that plans rows for ``isolate``; the library begins it and speaks to it."""

import signal
import sys
from typing import List

from . import _native


def main(arguments: List[str]) -> None:
    # What is sent to the whole batch: the batch ends its workers itself.
    for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(sent, signal.SIG_IGN)
    batch, fingerprint, time_limit, start, trajectories = arguments
    limit = float(time_limit) if time_limit else None
    _native.serve_rows(batch, fingerprint, limit, start or None, bool(trajectories))


if __name__ == "__main__":
    main(sys.argv[1:])
