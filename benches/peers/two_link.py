"""The planar two-link arm on a free base in closed form, as one would write it by hand.

With absolute angular rates ψ₀, ψ₁, ψ₂ of the three bodies the kinetic energy about the common mass
centre is ½ψᵀN(θ)ψ. Its diagonal is constant, and the other entries are constants times the cosines
of θ₁, θ₂ and θ₁ + θ₂; the velocity terms have the sines. Momentum and the accelerations follow from
this one 3×3 matrix.
"""

from __future__ import annotations

import casadi as ca

import robot_file as robots


def fits(robot: robots.Robot) -> bool:
    """Whether the robot is such an arm: two joints about z, everything along x."""
    along = all(
        joint.kind == "revolute"
        and joint.axis == (0.0, 0.0, 1.0)
        and joint.rpy == robots.ZERO
        and joint.xyz[1:] == joint.body.com[1:] == (0.0, 0.0)
        and joint.parent == (index - 1 if index else None)
        for index, joint in enumerate(robot.joints)
    )
    return along and len(robot.joints) == 2 and robot.base.com == robots.ZERO


def dynamics(robot: robots.Robot, theta: ca.SX, rate: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Mass centre in axes of the base, base rate (a scalar) and H⁻¹Cθ̇.

    Masses, mass centres and inertias may be symbols.
    """
    (shoulder, elbow), base = robot.joints, robot.base
    m0, m1, m2 = base.mass, shoulder.body.mass, elbow.body.mass
    b0, a1, l1, a2 = shoulder.xyz[0], shoulder.body.com[0], elbow.xyz[0], elbow.body.com[0]
    i0, i1, i2 = (body.inertia[2][2] for body in (base, shoulder.body, elbow.body))
    total = m0 + m1 + m2

    # Of each pair of bodies the reduced mass; the vector between them has these lengths along the
    # axes of base, upper arm and forearm.
    p01, p12, p02 = m0 * m1 / total, m1 * m2 / total, m0 * m2 / total
    k00 = i0 + (p01 + p02) * b0**2
    k11 = i1 + p01 * a1**2 + p12 * (l1 - a1) ** 2 + p02 * l1**2
    k22 = i2 + (p12 + p02) * a2**2
    k01 = (p01 * a1 + p02 * l1) * b0
    k12 = (p12 * (l1 - a1) + p02 * l1) * a2
    k02 = p02 * a2 * b0

    c1, s1, c2, s2 = ca.cos(theta[0]), ca.sin(theta[0]), ca.cos(theta[1]), ca.sin(theta[1])
    c12, s12 = c1 * c2 - s1 * s2, s1 * c2 + c1 * s2
    n01, n12, n02 = k01 * c1, k12 * c2, k02 * c12

    # No angular momentum: the rows of N over (ω, ω + θ̇₁, ω + θ̇₁ + θ̇₂) add up to zero.
    row0, row1, row2 = k00 + n01 + n02, k11 + n01 + n12, k22 + n02 + n12
    coupled = row1 + row2
    omega = -(coupled * rate[0] + row2 * rate[1]) / (row0 + coupled)

    psi1 = omega + rate[0]
    psi2 = psi1 + rate[1]
    q0, q1, q2 = omega * omega, psi1 * psi1, psi2 * psi2
    t01, t12, t02 = k01 * s1, k12 * s2, k02 * s12
    f0 = -(t01 * q1 + t02 * q2)
    f1 = t01 * q0 - t12 * q2
    f2 = t02 * q0 + t12 * q1

    # N⁻¹f by cofactors; joint accelerations are differences of absolute ones.
    d00, d11, d22 = k11 * k22 - n12 * n12, k00 * k22 - n02 * n02, k00 * k11 - n01 * n01
    d01, d02, d12 = n02 * n12 - n01 * k22, n01 * n12 - n02 * k11, n01 * n02 - n12 * k00
    x0 = d00 * f0 + d01 * f1 + d02 * f2
    x1 = d01 * f0 + d11 * f1 + d12 * f2
    x2 = d02 * f0 + d12 * f1 + d22 * f2
    scale = 1.0 / (k00 * d00 + n01 * d01 + n02 * d02)
    bias = ca.vertcat((x1 - x0) * scale, (x2 - x1) * scale)

    e0, e1, e2 = (m1 + m2) * b0 / total, (m1 * a1 + m2 * l1) / total, m2 * a2 / total
    center = ca.vertcat(e0 + e1 * c1 + e2 * c12, e1 * s1 + e2 * s12)
    return center, omega, bias
