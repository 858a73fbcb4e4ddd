graph g() { buffer b : u32[9 % 4] }
