//! The static table: names that every implementation knows. `[spec: ENC-12]`
//!
//! Found by a hash of three of their bytes and their length, which is made when this is compiled: most names
//! of the table take one comparison, most others none or one.

/// The names, ascending by bytes. Frozen: another table is another version of the encoding.
pub(super) const NAMES: [&str; 64] = [
    "RT",
    "agent",
    "agent_description",
    "agent_id",
    "agent_name",
    "battery_load",
    "cam_depth",
    "cam_rgb",
    "color",
    "cpu_usage",
    "depth",
    "door",
    "finished",
    "has",
    "height",
    "in",
    "is_performing",
    "laser",
    "laser_angles",
    "laser_dists",
    "level",
    "mass",
    "memory_usage",
    "mesh",
    "name",
    "num_procs",
    "object",
    "omnirobot",
    "parent",
    "path",
    "person",
    "plane",
    "pos_x",
    "pos_y",
    "priority",
    "rgbd",
    "robot",
    "robot_current_advance_speed",
    "robot_current_angular_speed",
    "robot_current_side_speed",
    "robot_local_angular_velocity",
    "robot_local_linear_velocity",
    "robot_ref_adv_speed",
    "robot_ref_rot_speed",
    "robot_ref_side_speed",
    "room",
    "rt_quaternion",
    "rt_rotation_euler_xyz",
    "rt_rotation_euler_xyz_velocity",
    "rt_se2_covariance",
    "rt_timestamps",
    "rt_translation",
    "rt_translation_velocity",
    "scalex",
    "scaley",
    "scalez",
    "source",
    "texture",
    "timestamp_agent",
    "timestamp_alivetime",
    "timestamp_creation",
    "transform",
    "wants_to",
    "width",
];

/// Four times as many as names, so that most of what is asked for and not there meets an empty one at once.
const SLOTS: usize = 256;

/// In each slot the place of a name, counted from 1, or 0. Who does not fit goes to the next free one.
const TABLE: [u8; SLOTS] = {
    let mut table = [0; SLOTS];
    let mut at = 0;
    while at < NAMES.len() {
        let mut slot = slot_of(NAMES[at].as_bytes());
        while table[slot] != 0 {
            slot = (slot + 1) % SLOTS;
        }
        #[allow(clippy::cast_possible_truncation, reason = "64 names")]
        let place = at as u8 + 1;
        table[slot] = place;
        at += 1;
    }
    table
};

/// The slot where a search begins.
const fn slot_of(name: &[u8]) -> usize {
    let length = name.len();
    if length == 0 {
        return 0;
    }
    let (first, middle, last) = (name[0] as usize, name[length / 2] as usize, name[length - 1] as usize);
    (length * 47 + first * 44 + middle * 44 + last * 181) % SLOTS
}

/// The index of a name in the table.
pub(super) fn index_of(name: &str) -> Option<usize> {
    let mut slot = slot_of(name.as_bytes());
    loop {
        let index = usize::from(TABLE[slot]).checked_sub(1)?;
        if NAMES[index] == name {
            return Some(index);
        }
        slot = (slot + 1) % SLOTS;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::String;

    /// Each name is found, and nothing that is one character away from one, unless it is another.
    /// `[spec: ENC-12]`
    #[test]
    fn oracle_the_hash_finds_what_a_search_finds() {
        assert!(NAMES.is_sorted_by(|left, right| left < right));
        for (at, name) in NAMES.into_iter().enumerate() {
            assert_eq!(index_of(name), Some(at));
            for cut in 0..=name.len() {
                for between in ["", "a", "_", "\u{3c9}"] {
                    for skip in 0..=1.min(name.len() - cut) {
                        let near: String = [&name[..cut], between, &name[cut + skip..]].concat();
                        assert_eq!(index_of(&near), NAMES.binary_search(&&*near).ok(), "{near}");
                    }
                }
            }
        }
    }
}
