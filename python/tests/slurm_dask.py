"""Plans a batch on jobs of Slurm, and kills one of them once it has written a part.

python slurm_dask.py BATCH.toml DIR      where a Slurm is; scripts/slurm-check.sh starts one
"""

import pathlib
import subprocess
import sys
import threading
import time

from dask_jobqueue import SLURMCluster
from distributed import Client

import ffsm_ipopt.dask


def kill_one(folder):
    while not list(folder.glob("part-*.parquet")):
        time.sleep(0.1)
    listed = subprocess.run(["squeue", "-h", "-o", "%i"], check=True, capture_output=True, text=True)
    jobs = listed.stdout.split()
    assert len(jobs) == 2, jobs
    subprocess.run(["scancel", "--full", "--signal=KILL", jobs[0]], check=True)


def main(batch, out):
    job = {"cores": 1, "processes": 1, "memory": "1GB", "walltime": "00:10:00", "python": sys.executable}
    # The node has whatever memory it has, and everything is on loopback.
    here = {"job_extra_directives": ["--mem=0"], "interface": "lo", "log_directory": f"{out}-jobs"}
    loopback = {"scheduler_options": {"dashboard_address": "127.0.0.1:0"}}
    with SLURMCluster(**job, **here, **loopback) as cluster:
        cluster.adapt(minimum_jobs=2, maximum_jobs=2)
        with Client(cluster) as client:
            client.wait_for_workers(2)
            killer = threading.Thread(target=kill_one, args=(pathlib.Path(out),))
            killer.start()
            found = ffsm_ipopt.dask.run(batch, client, out, shards=4)
            killer.join()
    assert found.done == found.rows, found


if __name__ == "__main__":
    main(*sys.argv[1:])
