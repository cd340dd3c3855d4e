//! Arrays and strings that end where the memory ends: whoever reads or writes one element too many crashes.

use std::ffi::c_char;

/// A copy whose last element is the last before memory that is not there. It lives as long as the process.
pub fn edge<T: Copy>(values: &[T]) -> *mut T {
    let bytes = size_of_val(values);
    // SAFETY: room for so many bytes, which nobody else has; a multiple of the alignment before a page.
    unsafe {
        let start = end_of_memory(bytes).sub(bytes).cast::<T>();
        start.copy_from_nonoverlapping(values.as_ptr(), values.len());
        start
    }
}

/// Bytes and a zero behind them.
pub fn text(bytes: &[u8]) -> *const c_char {
    edge(&[bytes, &[0]].concat()).cast()
}

/// One byte off: no double, integer or pointer begins there.
pub fn misaligned<T: Copy + Default>() -> *mut T {
    edge(&[T::default(); 2]).cast::<u8>().wrapping_add(1).cast()
}

#[cfg(target_os = "linux")]
fn end_of_memory(bytes: usize) -> *mut u8 {
    use std::ffi::{c_int, c_long, c_void};
    use std::ptr::null_mut;

    const PAGE: usize = 1 << 16; // a multiple of every size of page
    const NONE: c_int = 0;
    const READ_WRITE: c_int = 3;
    const PRIVATE_ANONYMOUS: c_int = 0x22;
    unsafe extern "C" {
        fn mmap(at: *mut c_void, n: usize, protection: c_int, flags: c_int, file: c_int, offset: c_long)
        -> *mut c_void;
        fn mprotect(at: *mut c_void, n: usize, protection: c_int) -> c_int;
    }
    let room = bytes.next_multiple_of(PAGE);
    // SAFETY: fresh memory of this size, the last page of which nobody may touch.
    unsafe {
        let start = mmap(null_mut(), room + PAGE, READ_WRITE, PRIVATE_ANONYMOUS, -1, 0).cast::<u8>();
        assert_ne!(start.addr(), usize::MAX, "no memory");
        let end = start.add(room);
        assert_eq!(mprotect(end.cast(), PAGE, NONE), 0);
        end
    }
}

/// Elsewhere the end of an allocation of its own.
#[cfg(not(target_os = "linux"))]
fn end_of_memory(bytes: usize) -> *mut u8 {
    let words = bytes.div_ceil(size_of::<u64>());
    Vec::<u64>::leak(vec![0; words + 1])[words..].as_mut_ptr().cast()
}
