"""Builds a .blend for Cycles. Runs inside Blender: blender -b --factory-startup --python blender_scene.py -- SCENE.json

SCENE.json is written by cycles.py: files, materials, views, light and size. Axes stay hybridrt's (y up).
"""
import json
import math
import sys

import bpy
from mathutils import Matrix, Vector


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        facts = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"  # first: materials and lights have Cycles' properties from then on
    bpy.ops.wm.obj_import(filepath=facts["obj"])
    for thing in scene.objects:
        thing.matrix_world = Matrix.Identity(4)
    for name, values in facts["materials"].items():
        build_material(bpy.data.materials[name], values, facts["ambient"])
    add_camera(scene, facts["views"], facts["size_px"])
    add_sun(scene, facts)
    set_background(scene, facts["background"])
    set_render(scene, facts)
    bpy.ops.wm.save_as_mainfile(filepath=facts["blend"], compress=False)


def build_material(material, m, ambient):
    """Lambert and emission, which stands for ambient light; a sharp mirror or glass where MTL says so. No highlights: as
    lobes of their own they would send rays, and noise."""
    material.use_nodes = True
    material.cycles.sample_as_light = False  # what glows by ambient light lights nothing else
    tree = material.node_tree
    tree.nodes.clear()
    shaders = []
    if not m["glass"]:
        color = color_of(tree, m)
        shaders.append(node(tree, "ShaderNodeBsdfDiffuse", Color=scaled(tree, color, [m["d"]] * 3)))
        glow = add_colors(tree, scaled(tree, color, [m["d"] * a for a in ambient]), m["ke"])
        shaders.append(node(tree, "ShaderNodeEmission", Color=glow, Strength=1.0))
        if m["d"] < 1:
            shaders.append(node(tree, "ShaderNodeBsdfTransparent", Color=rgba([(1 - m["d"]) * t for t in m["tf"]])))
    if m["glass"] and m["ni"] != 1:
        shaders.append(node(tree, "ShaderNodeBsdfGlass", Color=rgba(m["tf"]), Roughness=0.0, IOR=m["ni"]))
    elif m["glass"]:
        shaders.append(node(tree, "ShaderNodeBsdfTransparent", Color=rgba(m["tf"])))
        shaders.append(mirror(tree, rgba(m["ks"])))
    elif m["schlick"]:
        shaders.append(mirror(tree, schlick(tree, m["ks"])))
    elif m["mirror"]:
        shaders.append(mirror(tree, rgba(m["ks"])))
    total = shaders[0].outputs[0]
    for shader in shaders[1:]:
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(total, both.inputs[0])
        tree.links.new(shader.outputs[0], both.inputs[1])
        total = both.outputs[0]
    tree.links.new(dark_to_diffuse_rays(tree, total), tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])


def dark_to_diffuse_rays(tree, shader):
    """Also without diffuse bounces Cycles sends a ray from a diffuse surface, for what glows. It finds nothing, without
    noise, and is spared the material's nodes."""
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(tree.nodes.new("ShaderNodeLightPath").outputs["Is Diffuse Ray"], mix.inputs[0])
    tree.links.new(shader, mix.inputs[1])
    return mix.outputs[0]


def mirror(tree, color):
    glossy = node(tree, "ShaderNodeBsdfGlossy", Color=color, Roughness=0.0)
    glossy.distribution = "SHARP"
    return glossy


def schlick(tree, ks):
    """Ks + (1 - Ks)(1 - cos)^5."""
    weight = tree.nodes.new("ShaderNodeLayerWeight")
    weight.inputs["Blend"].default_value = 0.5  # "Facing" is then 1 - cos
    power = tree.nodes.new("ShaderNodeMath")
    power.operation = "POWER"
    tree.links.new(weight.outputs["Facing"], power.inputs[0])
    power.inputs[1].default_value = 5
    mix = tree.nodes.new("ShaderNodeMixRGB")
    tree.links.new(power.outputs[0], mix.inputs["Fac"])
    mix.inputs["Color1"].default_value = rgba(ks)
    mix.inputs["Color2"].default_value = (1, 1, 1, 1)
    return mix.outputs["Color"]


def color_of(tree, m):
    """Kd, times the texture: a colour, or the output of a node."""
    if not m["map_kd"]:
        return rgba(m["kd"])
    image = tree.nodes.new("ShaderNodeTexImage")
    image.image = bpy.data.images.load(m["map_kd"], check_existing=True)
    return scaled(tree, image.outputs["Color"], m["kd"])


def scaled(tree, color, by):
    """`color`, a value or a node's output, times three numbers."""
    if not isinstance(color, bpy.types.NodeSocket):
        return rgba([c * b for c, b in zip(color, by)])
    return mixed(tree, "MULTIPLY", color, by)


def add_colors(tree, color, other):
    if not isinstance(color, bpy.types.NodeSocket):
        return rgba([c + o for c, o in zip(color, other)])
    return mixed(tree, "ADD", color, other) if max(other) > 0 else color


def mixed(tree, blend_type, color, other):
    mix = tree.nodes.new("ShaderNodeMixRGB")
    mix.blend_type = blend_type
    mix.inputs["Fac"].default_value = 1
    tree.links.new(color, mix.inputs["Color1"])
    mix.inputs["Color2"].default_value = rgba(other)
    return mix.outputs["Color"]


def node(tree, kind, **inputs):
    made = tree.nodes.new(kind)
    for name, value in inputs.items():
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, made.inputs[name])
        else:
            made.inputs[name].default_value = value
    return made


def rgba(values):
    return (*list(values)[:3], 1.0)


def add_camera(scene, views, size_px):
    """A key at every frame."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL" if size_px[0] >= size_px[1] else "HORIZONTAL"
    data.clip_start, data.clip_end = 1e-3, 1e5
    camera = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.rotation_mode = "QUATERNION"
    for frame, view in enumerate(views, 1):
        data.angle_y = math.radians(view["fov_y_deg"])
        axes = Matrix((view["right"], view["up"], [-x for x in view["forward"]])).transposed()
        camera.location = view["eye"]
        camera.rotation_quaternion = axes.to_quaternion()
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_quaternion", frame=frame)


def add_sun(scene, facts):
    data = bpy.data.lights.new("sun", "SUN")
    data.angle = 0
    data.energy = math.pi * facts["light"]  # a white surface that faces it has the radiance `light`
    data.use_shadow = data.cycles.cast_shadow = facts["shadow"]
    data.cycles.use_multiple_importance_sampling = False
    sun = bpy.data.objects.new("sun", data)
    scene.collection.objects.link(sun)
    sun.rotation_mode = "QUATERNION"
    sun.rotation_quaternion = Vector(facts["toward_light"]).to_track_quat("Z", "Y")


def set_background(scene, color):
    """Seen by the camera and in mirrors; it lights nothing."""
    world = bpy.data.worlds.new("world")
    scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = rgba(color)
    world.cycles.sampling_method = "NONE"
    world.cycles_visibility.diffuse = False


def set_render(scene, facts):
    """One sample through the pixel's middle; no more rays than hybridrt's generations; nothing after rendering."""
    cycles, render, depth = scene.cycles, scene.render, facts["depth"]
    cycles.device = "CPU"
    cycles.samples = 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = cycles.transparent_max_bounces = depth
    cycles.diffuse_bounces = cycles.volume_bounces = 0
    cycles.use_auto_tile = False
    render.use_persistent_data = True
    render.use_compositing = render.use_sequencer = False
    render.resolution_x, render.resolution_y = facts["size_px"]
    render.resolution_percentage = 100
    render.image_settings.file_format, render.image_settings.color_mode, render.image_settings.color_depth = "PNG", "RGB", "8"
    render.dither_intensity = 0
    scene.view_settings.view_transform = "Standard"  # the sRGB curve
    scene.view_settings.look = "None"


main()
