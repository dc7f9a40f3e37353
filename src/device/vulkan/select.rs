//! Which device a person means.

use crate::device::{Error, Facts};

/// A number up to this long is an index before it is a part of a name.
const INDEX_DIGITS: usize = 3;

/// The index that `selector` means among `devices`.
///
/// In this order: `None` is the first device; a short decimal number an index; 32 hexadecimal digits, dashes
/// allowed, a UUID; otherwise a whole name, then a part of one, in any case.
pub(super) fn choose(devices: &[Facts], selector: Option<&str>) -> Result<usize, Error> {
    if devices.is_empty() {
        return Err(Error::NoDevice);
    }
    let Some(selector) = selector else {
        return Ok(0);
    };
    let wanted = selector.trim();
    if wanted.len() <= INDEX_DIGITS
        && wanted.bytes().all(|byte| byte.is_ascii_digit())
        && let Ok(index) = wanted.parse::<usize>()
        && index < devices.len()
    {
        return Ok(index);
    }
    let lower = wanted.to_lowercase();
    let digits: String = lower.chars().filter(|&digit| digit != '-').collect();
    let uuid = digits.len() == 32 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let name = |device: &Facts| device.name.to_lowercase();
    let find = |matching: &dyn Fn(&Facts) -> bool| -> Vec<usize> {
        (0..devices.len()).filter(|&index| matching(&devices[index])).collect()
    };
    let mut found = Vec::new();
    if uuid {
        found = find(&|device| device.uuid == digits);
    }
    if found.is_empty() {
        found = find(&|device| name(device) == lower);
    }
    if found.is_empty() && !lower.is_empty() {
        found = find(&|device| name(device).contains(&lower));
    }
    let titles = |indices: &[usize]| -> Vec<String> {
        indices.iter().map(|&index| format!("{index} '{}'", devices[index].name)).collect()
    };
    match found[..] {
        [one] => Ok(one),
        [] => Err(Error::UnknownDevice {
            selector: selector.to_owned(),
            known: titles(&(0..devices.len()).collect::<Vec<_>>()),
        }),
        _ => Err(Error::AmbiguousDevice { selector: selector.to_owned(), matches: titles(&found) }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(index: usize, name: &str, uuid: &str) -> Facts {
        Facts {
            index,
            name: name.to_owned(),
            kind: "other".to_owned(),
            uuid: uuid.to_owned(),
            vendor_id: 0,
            device_id: 0,
            driver: String::new(),
            driver_info: String::new(),
            driver_version: 0,
            api_version: "1.3.0".to_owned(),
            subgroup_size: 1,
            shader_float64: false,
            shader_float16: false,
            float_controls: None,
            max_storage_buffer_range: 1 << 27,
            unified_memory: true,
            timestamp_period: 1.0,
            timestamp_bits: 64,
            table_image_bits: 32,
            validation: false,
        }
    }

    fn machine() -> Vec<Facts> {
        vec![
            device(0, "NVIDIA T4", "00112233445566778899aabbccddeeff"),
            device(1, "NVIDIA T400", "ffeeddccbbaa99887766554433221100"),
            device(2, "llvmpipe (LLVM 15.0.6, 256 bits)", "6d657361323200000000000000000000"),
            device(3, "NVIDIA RTX 4090", "ffeeddccbbaa99887766554433221100"),
        ]
    }

    #[test]
    fn no_selector_means_the_first() {
        assert_eq!(choose(&machine(), None).unwrap(), 0);
    }

    #[test]
    fn a_short_number_is_an_index_and_a_long_one_a_name() {
        assert_eq!(choose(&machine(), Some("1")).unwrap(), 1);
        assert_eq!(choose(&machine(), Some(" 2 ")).unwrap(), 2);
        assert_eq!(choose(&machine(), Some("4090")).unwrap(), 3);
        // No such index, but a name has it.
        assert_eq!(choose(&machine(), Some("256")).unwrap(), 2);
        assert!(matches!(choose(&machine(), Some("77")), Err(Error::UnknownDevice { .. })));
    }

    #[test]
    fn a_uuid_may_have_dashes_and_any_case() {
        assert_eq!(choose(&machine(), Some("00112233-4455-6677-8899-AABBCCDDEEFF")).unwrap(), 0);
        assert_eq!(choose(&machine(), Some("6D657361323200000000000000000000")).unwrap(), 2);
        let unknown = "0".repeat(32);
        assert!(matches!(choose(&machine(), Some(&unknown)), Err(Error::UnknownDevice { .. })));
    }

    #[test]
    fn two_drivers_for_one_card_share_a_uuid_and_are_ambiguous() {
        let error = choose(&machine(), Some("ffeeddccbbaa99887766554433221100")).unwrap_err();
        assert!(matches!(&error, Error::AmbiguousDevice { matches, .. } if matches.len() == 2), "{error}");
    }

    #[test]
    fn a_whole_name_wins_over_a_part_of_another() {
        assert_eq!(choose(&machine(), Some("nvidia t4")).unwrap(), 0);
        assert_eq!(choose(&machine(), Some("t400")).unwrap(), 1);
        assert_eq!(choose(&machine(), Some("LLVMpipe")).unwrap(), 2);
    }

    #[test]
    fn errors_list_what_there_is() {
        let error = choose(&machine(), Some("nvidia")).unwrap_err().to_string();
        assert!(error.contains("0 'NVIDIA T4'") && error.contains("3 'NVIDIA RTX 4090'"), "{error}");
        let error = choose(&machine(), Some("radeon")).unwrap_err().to_string();
        assert!(error.contains("radeon") && error.contains("2 'llvmpipe"), "{error}");
        assert!(matches!(choose(&machine(), Some("")), Err(Error::UnknownDevice { .. })));
        assert!(matches!(choose(&[], None), Err(Error::NoDevice)));
        assert!(matches!(choose(&[], Some("0")), Err(Error::NoDevice)));
    }
}
