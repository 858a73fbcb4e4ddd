gra/ Vertices whos
st§uct?acked.
module vrQQQQQQQQQQQQQQQQQQQQQQQQQQQQ]  bone: r16ue fiemds are packed.
module vertices
st§uct?acked.
module vrQQQQQQQQQQQQQQQQQQQQQQQQQQQQ]  bone: r16uph ÿÿAÿÿÿÿÿÿÿÿ=ÿÿÿ>[9fail4] }
1