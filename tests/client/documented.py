"""The original client's public face: what scripts may call, by which argument names and with which defaults."""

BASE_OBJECT = """
__init__(a_name, time_out) ros_cb(data) is_active() get_sim_step() get_num_of_children() get_children_names() get_pos()
get_rot() get_rpy() get_pose() get_pos_command() get_rot_command() get_identifier() get_name() get_parent_name()
get_msg_header() get_msg_time_stamp() get_msg_seq_num() get_msg_frame_id() set_name(name) set_active() set_pos(px,py,pz)
set_rpy(roll,pitch,yaw) set_rot(quat) set_pose(pose) run_publisher()
"""
JOINTED = """
__init__(a_name,time_out=0.1) is_joint_idx_valid(joint_idx) get_joint_idx_from_name(joint_name)
get_joint_name_from_idx(joint_idx) get_joint_pos(joint_name_or_idx) get_all_joint_pos() get_num_joints()
get_joint_names() get_force_command() get_torque_command() get_publish_children_name_flag()
get_publish_joint_names_flag() get_publish_joint_positions_flag() set_publish_children_names_flag(state)
set_publish_joint_names_flag(state) set_publish_joint_positions_flag(state) set_active() get_inertia()
set_force(fx,fy,fz) set_torque(nx,ny,nz) set_wrench(wrench) pose_command(px,py,pz,roll,pitch,yaw,*jnt_cmds)
wrench_command(fx,fy,fz,nx,ny,nz)
"""
PUBLIC = {
    "Actuator": """__init__(a_name,time_out=0.1) actuate(obj_name,pose=None) actuate_from_sensor_data(sensor_identifer)
        deactuate()""",
    "BaseObject": BASE_OBJECT,
    "Camera": "__init__(a_name,time_out=0.1)",
    "Client": """__init__(client_name='ambf_client') set_publish_rate(rate) create_objs_from_rostopics(publish_rate)
        connect(default_publish_rate=120) refresh() start() get_common_namespace() get_world_handle() get_obj_names()
        get_obj_handle(a_name) get_obj_pose(a_name) set_obj_cmd(a_name,fx,fy,fz,nx,ny,nz) print_active_topics()
        print_summary() clean_up()""",
    "Light": "__init__(a_name,time_out=0.1)",
    "Object": JOINTED + "set_joint_pos(joint_name_or_idx,q) set_joint_effort(joint,effort)",
    "RigidBody": JOINTED
    + """get_linear_vel() get_angular_vel() get_joint_vel(joint_name_or_idx) get_joint_effort(joint_name_or_idx)
        get_all_joint_vel() get_all_joint_effort() get_pos_command() get_rot_command() get_linear_velocity_command()
        get_angular_velocity_command() set_pos(px,py,pz) set_rpy(roll,pitch,yaw) set_rot(quat) set_pose(pose)
        set_linear_vel(vx,vy,vz) set_angular_vel(ax,ay,az) set_twist(twist) velocity_command(vx,vy,vz,ax,ay,az)
        resize_joint_cmd_array(req_len) set_joint_pos(joint_name_or_idx,p) set_multiple_joint_pos(p_list,index_list)
        set_joint_vel(joint_name_or_idx,v) set_multiple_joint_vel(v_list,index_list)
        set_joint_effort(joint_name_or_idx,f) set_multiple_joint_effort(f_list,index_list)""",
    "Sensor": """__init__(a_name,time_out=0.1) get_count() is_triggered(idx) get_range(idx) get_measurement(idx)
        get_all_measurements() get_sensed_object(idx) get_parent() get_pose()""",
    "Vehicle": """__init__(a_name,time_out=0.1) get_wheel_count() check_wheel_count(idx)
        set_steered_wheel_indices(indices) initialize_wheel_cmds() set_powered_wheel_indices(indices)
        set_vehicle_steering(val) set_vehicle_steering_ackerman(val) set_vehicle_power(val) set_vehicle_brake(val)
        set_wheel_steering(idx,val) set_wheel_power(idx,val) set_wheel_brake(idx,val)""",
    "World": """__init__(a_name) set_active() is_active() enable_throttling(data) set_num_step_skips(n) ros_cb(data)
        update() clear_cmd() set_name(name) get_name() run_publisher() reset() reset_bodies()""",
    "WatchDog": """__init__(time_out=0.1) acknowledge_wd() is_wd_expired() console_print(class_name)
        set_timeout(time_out)""",
    "AmbfEnv": """__init__() skip_sim_steps(num) set_throttling_enable(check) make(a_name) reset() step(action)
        render(mode)""",
    "Observation": "__init__() cur_observation()",
}
# The file whose tests call every documented method of these classes.
WHERE_CALLED = {
    "test_old_style": ["Client", "WatchDog"],
    "test_old_style_objects": ["BaseObject", "Camera", "Light", "RigidBody", "World"],
    "test_old_style_served": ["Actuator", "Object", "Sensor", "Vehicle"],
    "test_env": ["AmbfEnv", "Observation"],
}


def methods(text):
    """{method: [(argument, default or None)]}"""
    found = {}
    for item in text.replace(", ", ",").split():
        name, _, arguments = item.rstrip(")").partition("(")
        pairs = [argument.partition("=") for argument in arguments.split(",") if argument]
        found[name] = [(argument, default or None) for argument, _, default in pairs]
    return found


def documented(module):
    """{(class, method)} that the tests of that file call."""
    file = module.rpartition(".")[2]
    return {(name, method) for name in WHERE_CALLED[file] for method in methods(PUBLIC[name])}
