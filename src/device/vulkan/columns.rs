//! Columns on their way into the device and out of it.

use std::sync::{Arc, Mutex};

use rayon::prelude::*;

use super::call::lock;
use super::engine::Engine;
use super::flight::Flight;
use super::lane::Extent;
use super::memory::Role;
use super::pool::Lease;
use crate::device::{Elapsed, Error, Outputs};

/// Rows transposed at a time: a block of six columns stays in a core's first cache.
const BLOCK: usize = 1024;

/// Input columns in the device's memory. Cheap to clone.
#[derive(Clone)]
pub struct Inputs {
    uploaded: Arc<Uploaded>,
}

struct Uploaded {
    rows: u32,
    columns: usize,
    /// The copy that fills the columns, while nobody has seen it finish. Before `lease`: dropped first.
    copy: Mutex<Option<Flight<Copying>>>,
    /// `None` for no rows.
    lease: Option<Arc<Lease>>,
}

/// What a copy needs until it is through.
struct Copying {
    _from: Lease,
    _to: Arc<Lease>,
}

impl Inputs {
    /// Copies row-major `rows`, `columns` wide, into columns.
    pub(super) fn upload(engine: &Arc<Engine>, rows: &[f32], columns: usize) -> Result<Self, Error> {
        if columns == 0 || !rows.len().is_multiple_of(columns) {
            return Err(Error::Shape(format!(
                "{} values are no whole rows of {columns} columns",
                rows.len()
            )));
        }
        let count = rows.len() / columns;
        if count > engine.max_rows(columns) {
            return Err(Error::Shape(format!(
                "{count} rows of {columns} columns are more than the {} that fit one buffer of this device",
                engine.max_rows(columns)
            )));
        }
        let mut uploaded = Uploaded { rows: count as u32, columns, copy: Mutex::new(None), lease: None };
        if count > 0 {
            let bytes = size_of_val(rows) as u64;
            let role = if engine.staging { Role::Upload } else { Role::SharedInputs };
            let mut host = engine.pool.lease(role, bytes)?;
            // SAFETY: the lease is new, so the device does not use it.
            transpose(rows, columns, &mut unsafe { host.write() }[..rows.len()]);
            if engine.staging {
                let (copy, lease) = copy_to_device(engine, host, bytes)?;
                uploaded.copy = Mutex::new(Some(copy));
                uploaded.lease = Some(lease);
            } else {
                uploaded.lease = Some(Arc::new(host));
            }
        }
        Ok(Self { uploaded: Arc::new(uploaded) })
    }

    /// Whether they are in this device's memory; no rows are in anyone's.
    pub(super) fn is_of(&self, engine: &Engine) -> bool {
        self.uploaded.lease.as_ref().is_none_or(|lease| lease.is_of(&engine.pool))
    }

    pub(super) fn rows(&self) -> u32 {
        self.uploaded.rows
    }

    pub(super) fn columns(&self) -> usize {
        self.uploaded.columns
    }

    /// The columns as the kernel reads them; `None` for no rows.
    pub(super) fn extent(&self) -> Option<Extent> {
        let bytes = u64::from(self.rows()) * self.columns() as u64 * 4;
        self.uploaded.lease.as_ref().map(|lease| Extent { buffer: lease.handle(), bytes })
    }

    /// Frees what the copy into the columns needed. Called when later work on the queue has finished: so has
    /// the copy.
    pub(super) fn settle(&self) {
        drop(lock(&self.uploaded.copy).take());
    }
}

/// Starts copying `host` into device memory. Work submitted later sees the copy finished.
fn copy_to_device(
    engine: &Arc<Engine>,
    host: Lease,
    bytes: u64,
) -> Result<(Flight<Copying>, Arc<Lease>), Error> {
    let device = Arc::new(engine.pool.lease(Role::DeviceColumns, bytes)?);
    let (from, to) = (Extent { buffer: host.handle(), bytes }, device.handle());
    let mut flight = Flight::new(engine, Copying { _from: host, _to: Arc::clone(&device) })?;
    let commands = flight.lane().record_copy(from, to)?;
    flight.submit(commands, true)?;
    Ok((flight, device))
}

/// Writes row-major `rows` as columns, one after another.
fn transpose(rows: &[f32], columns: usize, out: &mut [f32]) {
    let count = rows.len() / columns;
    let mut blocks: Vec<Vec<&mut [f32]>> = Vec::new();
    blocks.resize_with(count.div_ceil(BLOCK), || Vec::with_capacity(columns));
    for column in out.chunks_exact_mut(count) {
        for (block, part) in blocks.iter_mut().zip(column.chunks_mut(BLOCK)) {
            block.push(part);
        }
    }
    let fill = |(block, parts): (&[f32], Vec<&mut [f32]>)| {
        for (column, part) in parts.into_iter().enumerate() {
            for (slot, row) in part.iter_mut().zip(block.chunks_exact(columns)) {
                *slot = row[column];
            }
        }
    };
    if blocks.len() < 4 {
        rows.chunks(BLOCK * columns).zip(blocks).for_each(fill);
    } else {
        rows.par_chunks(BLOCK * columns).zip(blocks).for_each(fill);
    }
}

/// Output columns in memory that the host sees.
pub struct OutputColumns {
    rows: usize,
    /// `None` for no rows. The device is done with it.
    lease: Option<Lease>,
    elapsed: Elapsed,
}

impl OutputColumns {
    /// `lease` holds columns of `rows` values each, which the device has finished writing.
    pub(super) fn new(rows: usize, lease: Option<Lease>, elapsed: Elapsed) -> Self {
        Self { rows, lease, elapsed }
    }
}

impl Outputs for OutputColumns {
    fn column(&self, column: usize) -> &[f32] {
        let Some(lease) = &self.lease else {
            return &[];
        };
        // SAFETY: the submission that wrote this has finished, and only this value has the lease.
        let columns = unsafe { lease.read() };
        &columns[column * self.rows..(column + 1) * self.rows]
    }

    fn elapsed(&self) -> Elapsed {
        self.elapsed
    }
}

#[cfg(test)]
mod tests {
    use super::transpose;

    #[test]
    fn columns_hold_what_the_rows_held() {
        for columns in [1, 3, 6] {
            for count in [1, 63, 4096, 4097, 50_001] {
                let rows: Vec<f32> = (0..count * columns).map(|value| value as f32).collect();
                let mut out = vec![f32::NAN; rows.len()];
                transpose(&rows, columns, &mut out);
                for (index, &value) in out.iter().enumerate() {
                    let (column, row) = (index / count, index % count);
                    assert_eq!(
                        value,
                        rows[row * columns + column],
                        "{columns} columns, {count} rows, at {index}"
                    );
                }
            }
        }
    }
}
