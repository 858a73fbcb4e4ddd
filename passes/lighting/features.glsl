// The features of spectrum light_features that this kernel has, as bits LAMP_*.
const uint KERNEL = (round_spots ? LAMP_ROUND : 0u) | (square_spots ? LAMP_SQUARE : 0u) | (shadows ? LAMP_SHADOW : 0u) |
                    (soft_shadows ? LAMP_SOFT : 0u) | (pictures ? LAMP_PROJECTED : 0u) | (areas ? LAMP_AREA : 0u) | (tubes ? LAMP_TUBE : 0u) |
                    (darkness ? LAMP_DARK : 0u) | (clip_planes ? LAMP_CLIPPED : 0u);
