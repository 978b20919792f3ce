# yade -n -x make_periodic.py OUTDIR: spheres in a plane of a periodic cell, pressed together by shrinking and shearing
# the cell, then at rest. Exports with apps/exporters/yade_export.py (in the path) and O.save.
import sys, random
import yade_export
out = sys.argv[1]
random.seed(3)
r_max, per = 5e-3, 7
mat = FrictMat(young=1e7, poisson=0.5, frictionAngle=math.atan(0.3), density=2500)
O.materials.append(mat)
O.periodic = True
side = per * 2.05 * r_max
O.cell.hSize = Matrix3(side, 0, 0, 0, side, 0, 0, 0, 8 * r_max)
for k in range(per * per):
    r = random.uniform(0.7, 1) * r_max
    x, y = (k % per + 0.5) * 2.05 * r_max, (k // per + 0.5) * 2.05 * r_max
    s = O.bodies.append(sphere((x + random.uniform(-1, 1) * 0.05 * r_max, y, 4 * r_max), r, material=mat))
    O.bodies[s].state.blockedDOFs = 'zXY'
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.1 * r_max),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.4),
]
O.dt = 0.3 * PWaveTimeStep()
pressure = lambda: -0.5 * (getStress()[0, 0] + getStress()[1, 1])
while True:  # what collides on the way comes to rest before the pressure counts
    O.cell.velGrad = Matrix3(-0.4, 0.1, 0, 0, -0.4, 0, 0, 0, 0)
    O.run(1000, True)
    O.cell.velGrad = Matrix3.Zero
    if pressure() > 1e3:
        O.run(4000, True)
    if pressure() > 1e3:
        break
force = lambda b: max(abs(O.forces.f(b.id)[0]), abs(O.forces.f(b.id)[1]), abs(O.forces.t(b.id)[2]) / b.shape.radius)
for block in range(400):
    O.run(5000, True)
    worst = max(force(b) for b in O.bodies)
    if worst < 1e-11:
        break
print('pressure', pressure(), 'largest net force', worst, 'stress', getStress(), flush=True)
yade_export.export(out)
O.save(out + '/scene.xml.gz')
