"""Writes a packing of YADE for `indet import --format yade FOLDER`, every number with 17 digits.

In a script of YADE, or at its prompt, once the packing is at rest:

    import sys
    sys.path.append('/where/this/file/is')
    import yade_export
    yade_export.export('FOLDER')

The folder gets two tables. bodies.txt: spheres with position, radius, mass, moment of inertia, velocities, blocked
degrees of freedom; walls with axis and sense; boxes with their extents; the gravity of the NewtonIntegrator; and the
three vectors of the cell of a periodic scene.
interactions.txt: of each real interaction the bodies, the normal (from the first to the second), normal and shear
force on the second, penetration depth, and the tangent of the friction angle.
"""

import os

BODY_COLUMNS = 'id shape x y z radius mass inertia vx vy vz wx wy wz blocked material'
INTERACTION_COLUMNS = 'id1 id2 nx ny nz fnx fny fnz fsx fsy fsz pd tanphi'


def export(folder, scene=None):
    """Writes folder/bodies.txt and folder/interactions.txt. `scene`: YADE's O (default: the current one)."""
    if scene is None:
        from yade.wrapper import Omega
        scene = Omega()
    bodies = [_body(body) for body in scene.bodies if body is not None]
    interactions = [_interaction(interaction) for interaction in scene.interactions if interaction.isReal]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, 'bodies.txt'), 'w') as file:
        for engine in scene.engines:
            if type(engine).__name__ == 'NewtonIntegrator':
                file.write('# gravity %s\n' % _numbers(engine.gravity))
        if scene.periodic:  # the columns of hSize are the vectors
            file.write('# cell %s\n' % _numbers(scene.cell.hSize[i, k] for k in range(3) for i in range(3)))
        file.write('# %s\n' % BODY_COLUMNS)
        file.writelines(line + '\n' for line in bodies)
    with open(os.path.join(folder, 'interactions.txt'), 'w') as file:
        file.write('# %s\n' % INTERACTION_COLUMNS)
        file.writelines(line + '\n' for line in interactions)


def _numbers(values):
    return ' '.join('%.17g' % value for value in values)


def _body(body):
    shape = type(body.shape).__name__
    state = body.state
    start = '%d %s %s' % (body.id, shape, _numbers(state.pos))
    if shape == 'Sphere':
        numbers = [body.shape.radius, state.mass, state.inertia[2], *state.vel, *state.angVel]
        return '%s %s %s %d' % (start, _numbers(numbers), state.blockedDOFs or '-', body.mat.id)
    if shape == 'Wall':
        return '%s axis=%d sense=%d material=%d' % (start, body.shape.axis, body.shape.sense, body.mat.id)
    if shape == 'Box':
        turned = max(abs(state.ori[i]) for i in range(3)) > 1e-12  # the vector part of a quaternion
        extents = 'hx=%.17g hy=%.17g hz=%.17g' % tuple(body.shape.extents)
        return '%s %s turned=%d material=%d' % (start, extents, turned, body.mat.id)
    raise ValueError('body %d is a %s; only spheres, walls and boxes can be exported' % (body.id, shape))


def _interaction(interaction):
    geom, phys = interaction.geom, interaction.phys
    numbers = [*geom.normal, *phys.normalForce, *phys.shearForce, geom.penetrationDepth, phys.tangensOfFrictionAngle]
    return '%d %d %s' % (interaction.id1, interaction.id2, _numbers(numbers))
