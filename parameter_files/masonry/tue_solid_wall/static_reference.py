#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Elastic lateral stiffness of the wall by static finite elements.

  static_reference.py OUTPUT_DIR

Takes from a run only the mesh (reference positions, triangles, joint sets);
assembles linear triangles and joint springs anew and solves them densely.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                *[os.pardir] * 3, "scripts"))
import numpy as np, vtu
from collections import defaultdict
g=vtu.read_at(os.path.join(sys.argv[1], 'blocks.pvd')); j=vtu.read_at(os.path.join(sys.argv[1], 'joints.pvd'))
P=g.points; C=g.cells; E,nu,t=16.7e9,.15,.1
D=E/(1-nu**2)*np.array([[1,nu,0],[nu,1,0],[0,0,(1-nu)/2]]); n=len(P)
K=np.zeros((2*n,2*n))
for c in C:
    x=P[c]; d=np.linalg.det(np.array([x[1]-x[0],x[2]-x[0]])); A=abs(d)/2
    b=np.array([x[1,1]-x[2,1],x[2,1]-x[0,1],x[0,1]-x[1,1]])/d; cc=np.array([x[2,0]-x[1,0],x[0,0]-x[2,0],x[1,0]-x[0,0]])/d
    B=np.zeros((3,6)); B[0,::2]=b; B[1,1::2]=cc; B[2,::2]=cc; B[2,1::2]=b
    dof=np.ravel(np.column_stack([2*c,2*c+1])); K[np.ix_(dof,dof)]+=B.T@D@B*A*t
key=lambda p:(int(round(p[0]*1e5)),int(round(p[1]*1e5)))
jp=j.points-j.point_data['displacement'][:,:2]
sets={}
for f in range(len(jp)//2): sets[key((jp[2*f]+jp[2*f+1])/2)]=j.cell_data['joint set'][f]
cnt=defaultdict(list)
for c in C:
    for i in range(3): cnt[frozenset((c[i],c[(i+1)%3]))].append((c[i],c[(i+1)%3]))
ed=defaultdict(list)
for f,l in cnt.items():
    if len(l)==1: a,b=l[0]; ed[key((P[a]+P[b])/2)].append((a,b))
def solve(stiff_heads):
    M=K.copy(); m=0
    for k,l in ed.items():
        if len(l)!=2: continue
        m+=1; (a,b),(c,d)=l; L=np.linalg.norm(P[a]-P[b]); vert=abs(P[a][0]-P[b][0])<1e-9
        kn,ks=(82e9,36e9) if sets[k]==0 else (1e15,1e15)
        if vert and stiff_heads: kn=ks=1e15
        for p,q in ((a,d),(b,c)):
            assert np.linalg.norm(P[p]-P[q])<1e-9
            for dd in range(2):
                kk=(kn if (dd==0)==vert else ks)*L*t/2
                for r,s,v in ((p,p,1),(q,q,1),(p,q,-1),(q,p,-1)): M[2*r+dd,2*s+dd]+=kk*v
    block_y=np.zeros(n)
    cy=defaultdict(list)
    top=np.zeros(n,bool); bot=np.zeros(n,bool)
    for c in C:
        y=P[c,1].mean()
        if y>1.0: top[c]=True
        if y<0: bot[c]=True
    fixed=top|bot; u=np.zeros(2*n); u[0::2][top]=1e-5
    fd=np.repeat(fixed,2); fr=~fd
    u[fr]=np.linalg.solve(M[np.ix_(fr,fr)],-M[np.ix_(fr,fd)]@u[fd])
    F=(M@u)[0::2][top].sum()
    print(m,'stiff heads' if stiff_heads else 'as given',F/1e-5/1e6,'kN/mm')
solve(False); solve(True)
