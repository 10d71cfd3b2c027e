"""What concerns the whole process: signals, the lock of the interpreter, imports."""

import signal
import subprocess
import sys
import threading

import pytest

import ffsm_ipopt as ffsm
from conftest import CONFIG

CALLS = {
    "plan": "ffsm.plan(problem, on_progress=begun)",
    "search": "ffsm.plan(problem, search=2000, on_progress=begun)",
    "plan_many": "ffsm.plan_many([problem] * 2000, on_record=begun)",
    "batch": "ffsm.batch({batch!r}, {out!r}, on_row=begun)",
}
CHILD = """
import signal
import ffsm_ipopt as ffsm
# A shell's background job, which the tests may be, ignores Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)
# No mesh is fine enough, so that planning does not end by itself for long.
values = {{"mesh.tolerance": 1e-13, "mesh.max_iterations": 1000, "mesh.method": "rpm"}} if {endless} else None
problem = ffsm.Problem.from_toml({path!r}, values)
said = False
def begun(_):
    global said
    if not said:
        said = True
        print("begun", flush=True)
try:
    {call}
    print("ended by itself", flush=True)
except KeyboardInterrupt:
    next = ffsm.plan(ffsm.Problem.from_toml({path!r}))
    print("interrupted, then", next.status, flush=True)
"""


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends_a_call_and_nothing_else(name, batch, tmp_path):
    path = str(CONFIG / "table1-smooth.toml")
    call = CALLS[name].format(batch=str(batch(2000)), out=str(tmp_path / "o"))
    code = CHILD.format(path=path, call=call, endless=name == "plan")
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    child.send_signal(signal.SIGINT)
    said, _ = child.communicate(timeout=300)
    assert said == "interrupted, then solved\n"
    assert child.returncode == 0


def test_two_threads_plan_at_once(smooth):
    """Two plans wait for each other in the middle."""
    both = threading.Barrier(2)
    met = []

    def plan():
        waited = False

        def wait(step):
            nonlocal waited
            if not waited:
                waited = True
                both.wait(timeout=60)
                met.append(step)

        ffsm.plan(smooth, on_progress=wait)

    threads = [threading.Thread(target=plan) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(met) == 2


def test_the_lock_of_the_interpreter_is_released(smooth):
    """A counter goes on while plans are made, though the interpreter does not switch threads by itself."""
    counted, stop = 0, threading.Event()
    begun = threading.Event()

    def count():
        nonlocal counted
        begun.set()
        while not stop.is_set():
            counted += 1
            stop.wait(0.0005)

    counter = threading.Thread(target=count)
    counter.start()
    begun.wait()
    before = counted
    sys.setswitchinterval(1000.0)
    try:
        ffsm.plan(smooth)
        during = counted - before
    finally:
        sys.setswitchinterval(0.005)
        stop.set()
        counter.join()
    assert during > 0


def test_importing_brings_numpy_alone():
    code = (
        "import sys, ffsm_ipopt; print('numpy' in sys.modules,"
        " [name for name in ('pandas', 'matplotlib', 'dask') if name in sys.modules])"
    )
    child = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert child.stdout == "True []\n"
