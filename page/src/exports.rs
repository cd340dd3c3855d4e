//! What JavaScript calls: pointers and lengths in the memory of the module.

use crate::desk::Desk;
use std::ptr::slice_from_raw_parts_mut;
use std::sync::{Mutex, PoisonError};

static DESK: Mutex<Desk> = Mutex::new(Desk::new());

/// Room for a question of so many bytes. It belongs to the next `ask`.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    Box::into_raw(vec![0_u8; length].into_boxed_slice()).cast()
}

/// Takes a question and gives its room back; 1 where there is an answer, 0 where it is a refusal.
///
/// # Safety
/// Pointer and length are those of `room`, and are used once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ask(at: *mut u8, length: usize) -> u32 {
    // SAFETY: the caller says that this room is from `room`, and that nobody else has it.
    let question = unsafe { Box::from_raw(slice_from_raw_parts_mut(at, length)) };
    u32::from(DESK.lock().unwrap_or_else(PoisonError::into_inner).take(&question))
}

/// Of the last answer: where its bytes (0) and its numbers (2) are, and how many of each (1, 3).
#[unsafe(no_mangle)]
pub extern "C" fn answered(what: u32) -> usize {
    let desk = DESK.lock().unwrap_or_else(PoisonError::into_inner);
    let answer = desk.answer();
    match what {
        0 => answer.bytes.as_ptr().addr(),
        1 => answer.bytes.len(),
        2 => answer.numbers.as_ptr().addr(),
        _ => answer.numbers.len(),
    }
}
