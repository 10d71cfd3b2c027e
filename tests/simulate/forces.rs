//! One disturbance at a time, against its closed form.

use crate::platforms::*;
use ffsm_ipopt::simulate::{Pad, Platform};

#[test]
fn a_tilted_floor_accelerates_the_whole_and_does_not_turn_it() {
    let (tilt, gravity) = (2e-4_f64, 9.80665);
    let run = run(&held(10.0), |platform| {
        platform.floor.tilt = [tilt, -0.5 * tilt]
    });
    for (t, x, turn) in moved(&run) {
        assert_near(x, 0.5 * gravity * tilt.sin() * t * t, 1e-10, "slide");
        assert_near(turn, 0.0, 1e-10, "turn");
    }
    let y = run.actual.last().unwrap()[1] - run.actual[0][1];
    assert_near(
        y,
        -50.0 * gravity * (0.5 * tilt).sin(),
        1e-9,
        "slide across",
    );
}

#[test]
fn the_air_film_slows_exponentially() {
    let (center, mass, _) = whole();
    let (speed, drag) = (0.05, 2.0);
    let run = run(&held(10.0), |platform| {
        platform.release.velocity = [speed, 0.0];
        platform.bearing.film_drag = drag;
        // One pad under the mass centre of the whole, so that it does not turn.
        platform.pads = vec![Pad {
            body: 0,
            at: [center, 0.0, 0.0],
            load: None,
        }];
    });
    for (t, x, turn) in moved(&run) {
        let rate = drag / mass;
        assert_near(x, speed / rate * (1.0 - (-rate * t).exp()), 1e-9, "slide");
        assert_near(turn, 0.0, 1e-9, "turn");
    }
}

#[test]
fn bearing_friction_stops_the_platform() {
    let (speed, friction, gravity) = (0.01, 1e-4, 9.80665);
    let run = run(&held(15.0), |platform| {
        platform.release.velocity = [0.6 * speed, 0.8 * speed];
        platform.bearing.friction = friction;
        platform.bearing.slip_speed = 1e-6;
    });
    // Every body is carried under its mass centre, so that friction does not turn the whole.
    let deceleration = friction * gravity;
    let stop = speed / deceleration;
    for (t, x, turn) in moved(&run) {
        let t = t.min(stop);
        let expected = 0.6 * (speed * t - 0.5 * deceleration * t * t);
        assert_near(x, expected, 1e-6, &format!("slide at {t}"));
        assert_near(turn, 0.0, 1e-8, "turn");
    }
    assert!(stop < 11.0);
}

#[test]
fn pads_on_a_circle_brake_a_turning_base() {
    let (_, _, inertia) = whole();
    let (rate, drag, radius) = (0.02, 0.5, 0.3);
    let (center, ..) = whole();
    let run = run(&held(5.0), |platform| {
        platform.release.rate = rate;
        // The arm is turned by its joints: they have to be stiff.
        platform.controller.bandwidth = STIFF;
        platform.bearing.film_drag = drag;
        // Two pads about the mass centre of the whole, which then does not move.
        platform.pads = [radius, -radius]
            .map(|r| Pad {
                body: 0,
                at: [center, r, 0.0],
                load: None,
            })
            .to_vec();
    });
    let decay = 2.0 * drag * radius * radius / inertia;
    for (t, _, turn) in moved(&run) {
        assert_near(
            turn,
            rate / decay * (1.0 - (-decay * t).exp()),
            1e-5,
            "turn",
        );
    }
}

#[test]
fn air_drag_slows_by_the_square_of_the_speed() {
    let (_, mass, _) = whole();
    let (speed, area) = (0.5, 2.0);
    let run = run(&held(10.0), |platform| {
        platform.release.velocity = [speed, 0.0];
        // In proportion to the masses, so that the whole does not turn.
        platform.air.drag_area = [15.20, 1.70, 1.20].map(|m| area * m / mass).to_vec();
    });
    let decay = 0.5 * 1.2 * area / mass;
    for (t, x, turn) in moved(&run) {
        assert_near(x, (1.0 + decay * speed * t).ln() / decay, 1e-9, "slide");
        assert_near(turn, 0.0, 1e-9, "turn");
    }
}

#[test]
fn the_umbilical_is_a_damped_spring() {
    let (center, mass, inertia) = whole();
    let (speed, stiffness, damping) = (0.02, 5.0, 1.5);
    let spring = |platform: &mut Platform| {
        platform.umbilical.at = [center, 0.0, 0.0];
        platform.release.velocity = [speed, 0.0];
        platform.umbilical.stiffness = stiffness;
    };
    let player = held(30.0);
    let omega = (stiffness / mass).sqrt();
    for (t, x, turn) in moved(&run(&player, spring)) {
        assert_near(x, speed / omega * (omega * t).sin(), 1e-8, "swing");
        assert_near(turn, 0.0, 1e-8, "turn");
    }
    let damped = run(&player, |platform| {
        spring(platform);
        platform.umbilical.damping = damping;
    });
    let decay = 0.5 * damping / mass;
    let omega = (stiffness / mass - decay * decay).sqrt();
    for (t, x, _) in moved(&damped) {
        let expected = speed / omega * (-decay * t).exp() * (omega * t).sin();
        assert_near(x, expected, 1e-8, "damped swing");
    }
    // Pulled to a point beside the start it swings about that point.
    let pulled = run(&player, |platform| {
        platform.umbilical.at = [center, 0.0, 0.0];
        platform.umbilical.stiffness = stiffness;
        platform.umbilical.anchor = Some([0.01, 0.0]);
    });
    let omega = (stiffness / mass).sqrt();
    for (t, x, _) in moved(&pulled) {
        assert_near(x, 0.01 * (1.0 - (omega * t).cos()), 1e-8, "pulled swing");
    }
    let (rate, torsion) = (0.05, 0.4);
    let twisted = run(&player, |platform| {
        platform.release.rate = rate;
        platform.umbilical.torsion = torsion;
        platform.controller.bandwidth = STIFF;
    });
    let omega = (torsion / inertia).sqrt();
    for (t, _, turn) in moved(&twisted) {
        assert_near(turn, rate / omega * (omega * t).sin(), 3e-5, "twist");
    }
}
