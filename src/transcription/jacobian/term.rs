//! What nonzeros are made of.

/// What a nonzero of the Jacobian is made of, beyond its constant part. In 32 bits: large meshes have
/// hundreds of thousands.
#[derive(Debug, Clone, Copy)]
pub(super) enum Term {
    /// −(T·width/2)·(derivative `slot` of the point).
    Rate { point: u32, slot: u32 },
    /// −(width/2)·f_row − (T·width/2)·α·(time derivative, where there is one).
    RateByDuration { point: u32, row: u32 },
    /// Derivative `slot` of the point as it is.
    Path { point: u32, slot: u32 },
    /// α·(time derivative of a path row).
    PathByDuration { point: u32, slot: u32 },
    /// Derivative `slot` of the ends.
    End { slot: u32 },
    /// Derivative `slot` of a way-point.
    WayPoint { way_point: u32, slot: u32 },
    /// −(T·quadrature weight)·(derivative `slot` of the point).
    Integrand { point: u32, slot: u32 },
    /// −(quadrature weight)·(g_output + T·α·(time derivative, where there is one)).
    IntegrandByDuration { point: u32, output: u32 },
    /// −side·(T/2)·f_row: by a free breakpoint at the start (−1) or the end (+1) of the segment.
    RateByKnot { point: u32, row: u32, side: i8 },
    /// −side·(T/2)·(weight of the rule)·g_output.
    IntegrandByKnot { point: u32, output: u32, side: i8 },
}
