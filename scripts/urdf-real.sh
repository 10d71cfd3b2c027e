#!/usr/bin/env bash
# Plans motions of robots whose URDF files others wrote, as they come: the UR5, the Kinova Jaco 2 and the
# Franka Panda of the PyPI package example-robot-data, each on a spacecraft of 200 kg.
#
# The files go to target/urdf-real, which a second run uses again; delete it to fetch them anew (130 MB).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

wheel=example-robot-data==6.0.0

home=$PWD/target/urdf-real
robots=$home/cmeel.prefix/share/example-robot-data/robots

if [ ! -f "$home/complete" ]; then
    rm -rf "$home"
    mkdir -p "$home/download"
    python3 -m pip download --quiet --no-deps --only-binary :all: --dest "$home/download" "$wheel"
    # The meshes, nearly all of it, are not needed.
    python3 - "$home" "$home"/download/*.whl <<'EOF'
import sys, zipfile
archive = zipfile.ZipFile(sys.argv[2])
archive.extractall(sys.argv[1], [name for name in archive.namelist() if name.endswith(".urdf")])
EOF
    rm -rf "$home/download"
    touch "$home/complete"
fi

cargo build --release --locked --bin ffsm-ipopt
program=${CARGO_TARGET_DIR:-target}/release/ffsm-ipopt

# problem NAME ROBOT START GOAL: a problem file like those in config/.
problem() {
    cat >"$home/$1.toml" <<EOF
schema = 1
name = "$1"
robot = $2

[base]
mass = 200.0
inertia = [20.0, 22.0, 24.0]
com = [0.0, 0.0, -0.4]

[task]
duration = 20.0
initial.joints = [$3]
final.joints = [$4]

[limits]
joint_velocity = 0.5
control = 0.5
base_attitude = 0.3
base_rate = 0.1

[cost]
final_base_attitude = 1.0
final_base_position = 1.0
base_rate = 0.6
joint_rate = 0.2
control = 0.1

[mesh]
segments = 10
points = 5
tolerance = 1e-5
EOF
}

problem ur5 "{ file = \"$robots/ur_description/urdf/ur5_robot.urdf\", end_effector = \"tool0\" }" \
    "0.0, -1.2, 1.5, -0.3, 1.57, 0.0" "0.8, -0.6, 0.9, -0.9, 1.2, 0.5"
problem kinova "\"$robots/kinova_description/robots/kinova.urdf\"" \
    "0.0, 2.9, 1.3, 4.2, 1.4, 0.0" "0.8, 3.4, 1.9, 3.6, 1.0, 0.5"
problem panda "{ file = \"$robots/panda_description/urdf/panda.urdf\", end_effector = \"panda_hand_tcp\", \
lock = { panda_finger_joint1 = 0.02, panda_finger_joint2 = 0.02 } }" \
    "0.0, -0.8, 0.0, -2.4, 0.0, 1.6, 0.8" "0.6, -0.3, 0.4, -1.8, 0.3, 2.0, 0.2"

for name in ur5 kinova panda; do
    "$program" check "$home/$name.toml"
    "$program" plan "$home/$name.toml" --out "out/$name"
    echo
done
