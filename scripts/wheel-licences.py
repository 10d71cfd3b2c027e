"""Puts the licences of all that a wheel bundles into the unpacked wheel at the path given.

Shared libraries are Debian's, each with the file of its package under /usr/share/doc; crates are linked in,
each with the files of its source. Ends with an error where one has none.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def package_of(path):
    """The Debian package that a library is from. Older file lists have no /usr in front."""
    path = pathlib.Path(path).resolve()
    for known in (path, pathlib.Path("/", *path.parts[2:])):
        found = subprocess.run(["dpkg", "-S", known], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(":")[0]
    sys.exit(f"error: {path}: no Debian package has it; its licence is not known")


def libraries(wheel, licences):
    built = next(wheel.glob("ffsm_ipopt/_native*.so"))
    bundled = {re.sub(r"-[0-9a-f]{8}(?=[-.])", "", path.name) for path in wheel.glob("ffsm_ipopt.libs/*.so*")}
    # The extension as it was built needs the libraries of the system; a link leads to the name they have here.
    needed = re.findall(r"=> (/\S+)", output("ldd", str(original(wheel))))
    system = {name: path for path in needed for name in (pathlib.Path(path).name, pathlib.Path(path).resolve().name)}
    packages = {}
    for name in sorted(bundled):
        if name not in system:
            sys.exit(f"error: {built.name}: bundles {name}, which the system does not have under that name")
        packages.setdefault(package_of(system[name]), []).append(name)
    for package, names in packages.items():
        source = pathlib.Path("/usr/share/doc", package, "copyright")
        if not source.exists():
            sys.exit(f"error: {source} is not there; expected the licence of {', '.join(names)}")
        shutil.copy(source, licences / f"{package}.txt")
        print(f"{package}: {', '.join(names)}")


def original(wheel):
    """The extension as it was built, taken out of the wheel beside."""
    raw = wheel.parent.parent / "raw"
    output("wheel", "unpack", "--dest", str(raw), str(next(raw.glob("*.whl"))))
    return next(raw.glob("*/ffsm_ipopt/_native*.so"))


def crates(licences):
    manifest = "python/Cargo.toml"
    features = ["--locked", "--filter-platform", "x86_64-unknown-linux-gnu"]
    metadata = json.loads(
        output("cargo", "metadata", "--format-version=1", "--manifest-path", manifest, *features)
    )
    tree = output(
        "cargo", "tree", "--locked", "--manifest-path", manifest, "--edges=normal", "--prefix=none",
        "--format={p}",
    )
    linked = {tuple(line.split()[:2]) for line in tree.splitlines() if line and "proc-macro" not in line}
    count = 0
    for package in metadata["packages"]:
        if (package["name"], "v" + package["version"]) not in linked or package["source"] is None:
            continue
        folder = pathlib.Path(package["manifest_path"]).parent
        files = [
            path
            for path in folder.iterdir()
            if path.is_file() and re.match(r"(?i)(licen[cs]e|copying|notice|copyright|unlicense)", path.name)
        ]
        own = licences / "crates" / f"{package['name']}-{package['version']}"
        own.mkdir(parents=True)
        (own / "SPDX.txt").write_text(f"{package['license'] or 'see the files beside'}\n")
        for path in files:
            shutil.copy(path, own / path.name)
        count += 1
    print(f"{count} crates")


def main():
    wheel = pathlib.Path(sys.argv[1]).resolve()
    licences = next(wheel.glob("*.dist-info")) / "licenses"
    licences.mkdir(exist_ok=True)
    for name in ("LICENSE-MIT", "LICENSE-APACHE"):
        shutil.copy(name, licences / name)
    libraries(wheel, licences)
    crates(licences)


if __name__ == "__main__":
    main()
