//! The processor time that Ipopt asks the kernel for.

/// Has Ipopt ask for the process's time no more than once a tick of the kernel's clock, some milliseconds.
///
/// Up to 3.13 Ipopt asks by `getrusage` at both ends of each of its parts, some hundred times an
/// iteration, whether anybody wants to know or not: an eighth of a small solve. A program that calls this
/// function anywhere has a `getrusage` of its own, which answers from memory within a tick, and which its
/// shared libraries call as well; a program that does not call it has nothing of this. Newer versions do
/// not ask, and elsewhere than on Linux nothing changes.
#[inline(always)] // The object that refers to the C code is then the caller's own.
pub fn read_by_tick() {
    #[cfg(all(ipopt_hsl_loader, target_os = "linux"))]
    {
        unsafe extern "C" {
            fn ffsm_usage_by_tick();
        }
        // SAFETY: the function has no arguments and does nothing.
        unsafe { ffsm_usage_by_tick() };
    }
}

#[cfg(all(test, ipopt_hsl_loader, target_os = "linux"))]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Processor time of this process, µs, as a shared library is told.
    fn spent() -> i64 {
        // SAFETY: all zeros is a `rusage`, and the function writes to one that is there.
        let usage = unsafe {
            let mut usage: libc::rusage = std::mem::zeroed();
            assert_eq!(libc::getrusage(libc::RUSAGE_SELF, &mut usage), 0);
            usage
        };
        let micros = |time: libc::timeval| time.tv_sec * 1_000_000 + time.tv_usec;
        micros(usage.ru_utime) + micros(usage.ru_stime)
    }

    #[test]
    fn time_goes_on_and_is_asked_for_once_a_tick() {
        read_by_tick();
        let start = spent();
        let mut turns = 0_u64;
        while spent() < start + 100_000 {
            turns += 1;
        }
        assert!(turns > 0);
        let seen: BTreeSet<i64> = (0..1000).map(|_| spent()).collect();
        assert!(seen.len() < 100, "{} values", seen.len());
    }
}
