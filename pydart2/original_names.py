"""The names that the original's classes had, as methods or properties: what is assigned over them is an error.

Other names are younger. They yield to attributes and methods of the user's own, which may be older.
"""

from __future__ import annotations

_NAMES = {
    "World": """
        CLASS_SKELETON add_built_skeleton add_capsule add_empty_skeleton add_skeleton add_skeleton_from_id
        add_weld_box check_collision collision_detector collision_detector_string create_collision_filter destroy
        disable_recording dt enable_recording frame g gravity is_recording nframes num_frames num_skeletons
        remove_all_constraints render render_contacts render_markers reset set_collision_detector set_frame
        set_gravity set_recording set_states set_time set_time_step skel states step t time time_step x
    """,
    "Skeleton": """
        C M P accelerations adjacent_body_check body bodynode bodynode_index build c clear_impulse com
        com_acceleration com_spatial_velocity com_velocity commands comms constraint_forces controller
        coriolis_and_gravity_forces dC ddC ddq dof dof_index dof_indices dq force_lower_limits force_upper_limits
        forces get_spd get_spd_extended get_spd_forces invM inv_mass_matrix is_mobile joint linear_momentum m mass
        mass_matrix name nbodies ndofs njoints num_bodynodes num_dofs num_joints position_differences
        position_lower_limits position_upper_limits positions q q_lower q_upper render render_with_color root_bodynode
        root_bodynodes self_collision_check set_accelerations set_adjacent_body_check set_commands set_controller
        set_forces set_mobile set_positions set_root_joint_to_trans_and_euler set_root_joint_to_weld
        set_self_collision_check set_states set_velocities states tau tau_lower tau_upper update_fk velocities
        velocity_differences x
    """,
    "BodyNode": """
        C I J T add_ext_force add_ext_force_with_arrow add_ext_torque angular_jacobian angular_jacobian_deriv
        angular_momentum build com com_linear_acceleration com_linear_velocity com_spatial_acceleration
        com_spatial_velocity dC dJ expand_jacobian friction_coeff gravity_mode id index_in_skeleton index_in_tree
        inertia is_collidable jacobian linear_jacobian linear_jacobian_deriv linear_momentum local_com m mass
        num_child_bodynodes num_child_joints num_dependent_dofs num_markers num_shapenodes relative_transform
        restitution_coeff set_collidable set_ext_force set_ext_force_with_arrow set_ext_torque set_friction_coeff
        set_gravity_mode set_inertia set_inertia_entries set_local_com set_mass set_restitution_coeff skel skid
        to_local to_world transform tree_index wid world_angular_acceleration world_angular_velocity world_jacobian
        world_jacobian_classic_deriv world_linear_acceleration world_linear_velocity world_spatial_acceleration
        world_spatial_velocity world_transform
    """,
    "Dof": """
        constraint_impulse coulomb_friction damping_coefficient has_position_limit id index index_in_joint
        index_in_skeleton index_in_tree initial_position initial_velocity position position_lower_limit
        position_upper_limit rest_position set_constraint_impulse set_coulomb_friction set_damping_coefficient
        set_initial_position set_initial_velocity set_position set_position_lower_limit set_position_upper_limit
        set_rest_position set_spring_stiffness set_velocity set_velocity_lower_limit set_velocity_upper_limit skel
        skid spring_stiffness tree_index velocity velocity_lower_limit velocity_upper_limit wid
    """,
    "Joint": """
        acceleration actuator_type axis axis1 axis1_in_world_frame axis2 axis2_in_world_frame axis_in_world_frame
        axis_order build child_body_node_id coulomb_friction damping_coefficient get_local_transform
        get_world_frame_after_transform get_world_frame_before_transform has_position_limit id is_dynamic is_kinematic
        is_position_limit_enforced num_dofs orientation_in_world_frame parent_body_node_id position
        position_in_world_frame position_lower_limit position_upper_limit rest_position set_acceleration
        set_actuator_type set_axis set_axis1 set_axis2 set_axis_order set_coulomb_friction set_damping_coefficient
        set_name set_position set_position_limit_enforced set_position_lower_limit set_position_upper_limit
        set_rest_position set_spring_stiffness set_transform_from_child_body_node set_transform_from_parent_body_node
        set_velocity skel skid spring_stiffness transform_from_child_body_node transform_from_parent_body_node type
        velocity wid
    """,
    "Marker": """
        build id local_position p render set_local_position skel skid wid world_position
    """,
}

ORIGINAL = {cls: frozenset(names.split()) for cls, names in _NAMES.items()}
