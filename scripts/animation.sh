#!/usr/bin/env bash
# Makes the moving picture of the README, docs/motion.svg, from a plan for config/still-base.toml: the planned
# motion beside that along the straight joint path, as their page has them.
# FFSM_BUILT names a folder that cargo built to before, to be used as it is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh # finds cargo where the shell does not

built=${FFSM_BUILT:-}
if [ -z "$built" ]; then
  cargo build --release --locked --bin ffsm-ipopt
  built=${CARGO_TARGET_DIR:-target}/release
fi
"$built/ffsm-ipopt" plan config/still-base.toml --quiet --out target/animation

python3 - target/animation/report.html docs/motion.svg <<'END'
import json
import math
import re
import sys

SECONDS, HOLD = 6.0, 2.0  # of the motion, and of its end
EVERY = 2  # frames of the page to one of the picture
WIDE, HIGH, TITLE = 420, 300, 34
TURN, LIFT = -1.0, 0.45  # whence the page sees it
FACES = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]

page = open(sys.argv[1]).read()
scene = json.loads(re.search(r'<script id="scene"[^>]*>(.*?)</script>', page, re.S).group(1))
corners = range(8)
origin = 8
arm = [scene["joints"][0], *(end for start, end in scene["links"] if start != origin)]
tip = scene["tips"][0]


def seen(frame, k):
    """To the right, upwards, towards the eye; m."""
    x, y, z = frame[3 * k : 3 * k + 3]
    near = math.cos(TURN) * x + math.sin(TURN) * y
    right = -math.sin(TURN) * x + math.cos(TURN) * y
    return right, math.cos(LIFT) * z - math.sin(LIFT) * near, math.cos(LIFT) * near + math.sin(LIFT) * z


def faces_to_the_eye(frame):
    middle = sum(seen(frame, k)[2] for k in corners) / 8
    return [face for face in FACES if sum(seen(frame, k)[2] for k in face) / 4 > middle + 1e-3]


motions = scene["motions"][:2]
points = [seen(frame, k)[:2] for motion in motions for frame in motion["frames"] for k in [*corners, *arm]]
low, high = ([edge(point[i] for point in points) for i in (0, 1)] for edge in (min, max))
scale = min((WIDE - 30) / (high[0] - low[0]), (HIGH - 30) / (high[1] - low[1]))
middle = [(a + b) / 2 for a, b in zip(low, high)]


def place(frame, k):
    right, up, _ = seen(frame, k)
    return WIDE / 2 + scale * (right - middle[0]), TITLE + HIGH / 2 - scale * (up - middle[1])


def text(frame, ks, join=" "):
    return join.join("%.1f,%.1f" % place(frame, k) for k in ks)


def animate(attribute, values):
    total = SECONDS + HOLD
    times = [SECONDS / total * k / (len(values) - 1) for k in range(len(values))]
    return '<animate attributeName="%s" dur="%gs" repeatCount="indefinite" keyTimes="%s;1" values="%s"/>' % (
        attribute, total, ";".join("%.4f" % time for time in times), ";".join([*values, values[-1]]))


def drawn(motion, x, title):
    frames = motion["frames"][::EVERY]
    first = frames[0]
    out = ['<g transform="translate(%g 0)">' % x]
    out.append('<text x="%g" y="22" text-anchor="middle" font-weight="600">%s</text>' % (WIDE / 2, title))
    shown = faces_to_the_eye(first)
    assert all(faces_to_the_eye(frame) == shown for frame in frames), "a face turns away from the eye"
    out += ['<polygon class="start" points="%s"/>' % text(first, face) for face in shown]
    for number, face in enumerate(shown):
        out.append('<polygon class="face%d" points="%s">%s</polygon>' % (
            number, text(first, face), animate("points", [text(frame, face) for frame in frames])))
    out.append('<polyline class="path" points="%s"/>' % " ".join(text(frame, [tip]) for frame in motion["frames"]))
    out.append('<polyline class="arm" points="%s">%s</polyline>' % (
        text(first, arm), animate("points", [text(frame, arm) for frame in frames])))
    for k in scene["joints"]:
        (cx, cy) = place(first, k)
        out.append('<circle r="3.2" cx="%.1f" cy="%.1f">%s%s</circle>' % (
            cx, cy, *(animate(name, ["%.1f" % place(frame, k)[i] for frame in frames]) for i, name in enumerate(("cx", "cy")))))
    return [*out, "</g>"]


turned = [max(abs(angle) for angle in motion["turned"]) for motion in motions]
titles = ["Planned: the base turns by %.1f°" % turned[0], "Straight joint path: by %.1f°" % turned[1]]
svg = [
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="system-ui, sans-serif" font-size="15" role="img">'
    % (2 * WIDE, HIGH + TITLE),
    "<title>A seven-joint arm on a free base: the planned motion beside that along the straight joint path</title>",
    "<style>text{fill:#1b1f24}rect{fill:#fff}polygon{stroke:#1b1f24;stroke-linejoin:round}.face0{fill:#7cc4ee}.face1{fill:#56b4e9}"
    ".face2{fill:#2f6f93}.start{fill:none;stroke:#8a949e;stroke-dasharray:4 4}.arm{fill:none;stroke:#0072b2;stroke-width:6;"
    "stroke-linecap:round;stroke-linejoin:round}.path{fill:none;stroke:#d55e00}circle{fill:#e69f00;stroke:#1b1f24}</style>",
    '<rect width="100%" height="100%" rx="8"/>',
]
for number, (motion, title) in enumerate(zip(motions, titles)):
    svg += drawn(motion, number * WIDE, title)
open(sys.argv[2], "w").write("\n".join([*svg, "</svg>"]) + "\n")
END
echo docs/motion.svg
